// Tests on every instruction set.
#pragma once

#include <string>
#include <vector>

#include "catch.h"
#include "trace/targets.h"

namespace limn::test {

// Runs check() on each instruction set that this processor has, and goes back to the best.
template <class Check>
void on_every_target(const Check& check) {
    const std::vector<std::string> names = trace::targets();
    for (const std::string& name : names) {
        REQUIRE(trace::force_target(name));
        INFO(name);
        check();
    }
    trace::force_target(names.front());
}

}  // namespace limn::test
