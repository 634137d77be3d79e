# Install rules, and the package files for find_package(limn CONFIG) and pkg-config. The installed tree may be moved.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/limn")

install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/limn" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(TARGETS limn_core limn_io limn_limn EXPORT limn
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
        INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(EXPORT limn NAMESPACE limn:: FILE limn-targets.cmake DESTINATION "${package_dir}")
if(LIMN_BUILD_APPS)
    install(TARGETS limn RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
    foreach(module limn_openimageio limn_bench_embree)
        if(TARGET ${module})
            install(TARGETS ${module} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/limn")
        endif()
    endforeach()
endif()

configure_package_config_file(
    "${PROJECT_SOURCE_DIR}/cmake/limn-config.cmake.in" "${PROJECT_BINARY_DIR}/limn-config.cmake"
    INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/limn-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/limn-config.cmake" "${PROJECT_BINARY_DIR}/limn-config-version.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FindLimnOpenImageIO.cmake"
        DESTINATION "${package_dir}")

# limn.pc gives the prefix relative to its own folder.
file(RELATIVE_PATH prefix_from_pc "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
string(REGEX REPLACE "/$" "" prefix_from_pc "${prefix_from_pc}")
set(requires "tbb libhwy")
if(LIMN_WITH_OPENIMAGEIO)
    string(APPEND requires " OpenImageIO")
endif()
configure_file("${PROJECT_SOURCE_DIR}/cmake/limn.pc.in" "${PROJECT_BINARY_DIR}/limn.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/limn.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
