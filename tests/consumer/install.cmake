# Installs the build in BUILD to FIRST, checks that everything is there, and moves it to MOVED.

file(REMOVE_RECURSE "${FIRST}" "${MOVED}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${FIRST}"
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
set(files include/limn/limn.h lib/liblimn_core.a lib/liblimn_io.a lib/pkgconfig/limn.pc
    lib/cmake/limn/limn-config.cmake lib/cmake/limn/limn-config-version.cmake lib/cmake/limn/limn-targets.cmake
    lib/cmake/limn/FindLimnOpenImageIO.cmake)
if(APPS)
    list(APPEND files bin/limn)
endif()
foreach(file IN LISTS files)
    if(NOT EXISTS "${FIRST}/${file}")
        message(SEND_ERROR "not installed: ${file}")
    endif()
endforeach()
file(RENAME "${FIRST}" "${MOVED}")

# With its module, in whatever folder.
if(APPS)
    file(WRITE "${MOVED}/a.obj" "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    execute_process(COMMAND "${MOVED}/bin/limn" render a.obj -o a.png --size 2x2 --spp 1 --quiet
                    WORKING_DIRECTORY "${MOVED}" COMMAND_ERROR_IS_FATAL ANY)
endif()
