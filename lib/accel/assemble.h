// From the binary tree to the wide one.
#pragma once

#include "accel/collapse.h"

namespace limn::accel {

// All but the cost of the tree whose root has these children. `indices`: of the primitives that split nodes count.
WideBvh assemble(const Slots& root, HugeVector<std::uint32_t> indices);

}  // namespace limn::accel
