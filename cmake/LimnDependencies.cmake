# Finds the libraries that limn uses.

find_package(Threads REQUIRED)
find_package(TBB REQUIRED CONFIG)
find_package(hwy REQUIRED CONFIG)
find_path(LIMN_RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)
find_path(LIMN_XXHASH_INCLUDE_DIR xxhash.h REQUIRED)

if(LIMN_WITH_IO)
    find_package(tinyobjloader REQUIRED CONFIG)
    find_package(nlohmann_json REQUIRED CONFIG)
    find_path(LIMN_STB_INCLUDE_DIR stb_image.h PATH_SUFFIXES stb REQUIRED)
endif()
if(LIMN_WITH_IO AND LIMN_WITH_OPENIMAGEIO)
    find_package(LimnOpenImageIO REQUIRED MODULE)
endif()
