// Which build of the inner loops is used: one for each instruction set, the best that the processor has unless a test
// says otherwise.
#pragma once

#include <string>
#include <vector>

namespace limn::trace {

// Those that there are and that this processor can run, the best first.
std::vector<std::string> targets();

// For tests: uses this one from now on. Not thread-safe. False if it is not among the targets.
bool force_target(const std::string& name);

}  // namespace limn::trace
