# Finds OpenImageIO and defines the imported target limn::openimageio. It does not use the package config of Debian.
# That config fails unless the tools and the Python bindings are installed too, and it names an include folder that
# Debian does not install. This file is installed, because limn's own package config uses it.

find_path(LimnOpenImageIO_INCLUDE_DIR OpenImageIO/imageio.h)
find_library(LimnOpenImageIO_LIBRARY OpenImageIO)
find_library(LimnOpenImageIO_UTIL_LIBRARY OpenImageIO_Util)
mark_as_advanced(LimnOpenImageIO_INCLUDE_DIR LimnOpenImageIO_LIBRARY LimnOpenImageIO_UTIL_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LimnOpenImageIO
    REQUIRED_VARS LimnOpenImageIO_LIBRARY LimnOpenImageIO_UTIL_LIBRARY LimnOpenImageIO_INCLUDE_DIR)

if(LimnOpenImageIO_FOUND AND NOT TARGET limn::openimageio)
    add_library(limn::openimageio UNKNOWN IMPORTED)
    set_target_properties(limn::openimageio PROPERTIES
        IMPORTED_LOCATION "${LimnOpenImageIO_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${LimnOpenImageIO_INCLUDE_DIR}"
        INTERFACE_LINK_LIBRARIES "${LimnOpenImageIO_UTIL_LIBRARY}")
endif()
