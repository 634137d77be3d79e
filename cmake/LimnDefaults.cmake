# Settings of limn's own targets. They have no effect on the targets of a project that adds limn as a subdirectory.

if(PROJECT_IS_TOP_LEVEL)
    if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
        set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
    endif()
    set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
    # The presets turn this on. It is off by default, because a newer compiler may have warnings that are not fixed yet.
    option(LIMN_WARNINGS_AS_ERRORS "Treat warnings in limn's own code as errors" OFF)
endif()
if(NOT CMAKE_RUNTIME_OUTPUT_DIRECTORY)  # programs load modules from their own folder
    set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
endif()

# Flags that make floating-point results the same for every compiler and whatever flags a project sets globally. g++ by
# default contracts a product and a sum to a fused multiply-add, which would change the results of intersection tests.
# g++ 12 from -O2 on drops the rounding in double(float(x)) when it vectorises neighbouring values. Boxes that are
# rounded outward would then no longer enclose their contents.
set(limn_exact_arithmetic -fno-fast-math -ffp-contract=off $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)

function(limn_target_defaults target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
    target_compile_options(${target} PRIVATE ${limn_exact_arithmetic} -Wall -Wextra -Wconversion -Wshadow)
    # g++ 12 warns wrongly of overlapping copies in "literal" + std::string (GCC bug 105651).
    target_compile_options(${target} PRIVATE
        $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
    if(LIMN_WARNINGS_AS_ERRORS)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
endfunction()
