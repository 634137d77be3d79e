# Runs PROGRAM without arguments in the folder WORK, where it must leave a PNG called PICTURE.

file(MAKE_DIRECTORY "${WORK}")
file(REMOVE "${WORK}/${PICTURE}")
execute_process(COMMAND "${PROGRAM}" WORKING_DIRECTORY "${WORK}" COMMAND_ERROR_IS_FATAL ANY)
file(READ "${WORK}/${PICTURE}" signature LIMIT 8 HEX)
if(NOT signature STREQUAL "89504e470d0a1a0a")
    message(FATAL_ERROR "${PICTURE} is not a PNG")
endif()
