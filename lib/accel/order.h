// The order in which a ray visits the children of a node, by the octant of its direction.
#pragma once

#include "accel/wide_bvh.h"

namespace limn::accel {

// Fills in `order`. \pre all else is filled in
void set_order(WideNode& node);

}  // namespace limn::accel
