# Builds SOURCE with nothing but the compiler CXX and what pkg-config says about limn in PREFIX, and runs it in WORK. limn
# is a static library alone, so that --static makes no difference.

set(ENV{PKG_CONFIG_PATH} "${PREFIX}/lib/pkgconfig")
execute_process(COMMAND pkg-config --cflags --libs limn OUTPUT_VARIABLE flags COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND pkg-config --static --cflags --libs limn OUTPUT_VARIABLE static_flags COMMAND_ERROR_IS_FATAL ANY)
if(NOT static_flags STREQUAL flags)
    message(FATAL_ERROR "pkg-config --static says '${static_flags}' instead of '${flags}'")
endif()
separate_arguments(CXX_FLAGS UNIX_COMMAND "${CXX_FLAGS}")
separate_arguments(flags UNIX_COMMAND "${flags}")
file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
execute_process(COMMAND "${CXX}" ${CXX_FLAGS} "${SOURCE}" -o program ${flags}
                WORKING_DIRECTORY "${WORK}" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${WORK}/program" WORKING_DIRECTORY "${WORK}" COMMAND_ERROR_IS_FATAL ANY)
