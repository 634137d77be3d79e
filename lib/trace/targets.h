// The instruction sets for which the inner loops are compiled. The best that the processor has is used, unless a test
// chooses another.
#pragma once

#include <string>
#include <vector>

namespace limn::trace {

// Returns the names of the instruction sets that were compiled and that this processor has, the best first.
std::vector<std::string> targets();

// Uses this instruction set from now on; for tests. Not thread-safe. Returns false if it is not among the targets.
bool force_target(const std::string& name);

}  // namespace limn::trace
