# What holds for limn's own targets. Nothing here leaks to a project that adds limn as a subdirectory.

if(PROJECT_IS_TOP_LEVEL)
    if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
        set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
    endif()
    set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
    # On in the presets, which are our own builds: the next compiler may warn of what today's does not.
    option(LIMN_WARNINGS_AS_ERRORS "Treat warnings in limn's own code as errors" OFF)
endif()
if(NOT CMAKE_RUNTIME_OUTPUT_DIRECTORY)  # programs and the modules that they load lie together
    set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
endif()

# Every rounding stands in the source: the same bits from every compiler, whatever flags a project sets for all of its own.
# A fused multiply-add instead of a product and a sum moves decisions of hits, and g++ makes them by default. g++ 12 loses
# the rounding in double(float(x)) where it packs neighbouring values into vectors (-O2 and up): boxes that are rounded
# outward would no longer enclose what they must.
set(limn_exact_arithmetic -fno-fast-math -ffp-contract=off $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)

function(limn_target_defaults target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
    target_compile_options(${target} PRIVATE ${limn_exact_arithmetic} -Wall -Wextra -Wconversion -Wshadow)
    # g++ 12 sees overlapping copies in "literal" + std::string where there are none (GCC bug 105651).
    target_compile_options(${target} PRIVATE
        $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
    if(LIMN_WARNINGS_AS_ERRORS)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
endfunction()
