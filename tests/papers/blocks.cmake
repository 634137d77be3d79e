# Takes the blocks out of PAPERS into FOLDER; the faults must be exactly EXPECTED.

cmake_policy(VERSION 3.21)
include("${CMAKE_CURRENT_LIST_DIR}/extract.cmake")
foreach(paper IN LISTS PAPERS)
    extract_blocks("${paper}" "${FOLDER}")
endforeach()
if(NOT "${faults}" STREQUAL "${EXPECTED}")
    message(FATAL_ERROR "found: ${faults}\nexpected: ${EXPECTED}")
endif()
