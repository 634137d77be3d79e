#define CATCH_CONFIG_RUNNER
#include "../catch.h"

#include <cstdlib>

int main(int argc, char** argv) {
    setenv("RC_PARAMS", "seed=20260101", /*overwrite*/ 0);  // see property.h
    return Catch::Session().run(argc, argv);
}
