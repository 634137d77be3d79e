// What every test program does before Catch2's main().
#include <cstdlib>
#include <iostream>

#include "trace/targets.h"

namespace {

const bool kPrepared = [] {
    setenv("RC_PARAMS", "seed=20260101", /*overwrite*/ 0);  // see property.h
    // Another build of the kernels than the best: SCALAR or EMU128, SSE4, AVX2, AVX3.
    if (const char* target = std::getenv("LIMN_TEST_TARGET"); target != nullptr && !limn::trace::force_target(target)) {
        std::cerr << "LIMN_TEST_TARGET: " << target << " is not here\n";  // CTest counts the test as skipped
        std::exit(EXIT_FAILURE);
    }
    return true;
}();

}  // namespace
