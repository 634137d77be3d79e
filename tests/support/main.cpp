#define CATCH_CONFIG_RUNNER
#include "../catch.h"

#include <cstdlib>
#include <iostream>

#include "trace/targets.h"

int main(int argc, char** argv) {
    setenv("RC_PARAMS", "seed=20260101", /*overwrite*/ 0);  // see property.h
    // Another build of the kernels than the best: SCALAR or EMU128, SSE4, AVX2, AVX3.
    if (const char* target = std::getenv("LIMN_TEST_TARGET");
        target != nullptr && !limn::trace::force_target(target)) {
        std::cerr << "LIMN_TEST_TARGET: " << target << " is not here\n";
        return 4;  // CTest counts the test as skipped
    }
    // Catch returns how many assertions failed, which 4 may be.
    return Catch::Session().run(argc, argv) == 0 ? 0 : 1;
}
