// Builds the upper part of a tree over many build primitives. The surface-area heuristic is applied to the cells of a
// grid. This takes two passes over the primitives for all levels. Bins would take a pass for each level.
#pragma once

#include <deque>
#include <vector>

#include "geometry/bvh/build_primitive.h"
#include "geometry/bvh/collapse.h"

namespace limn::accel {

// Returns true if the centres of the range differ enough for a grid.
bool has_extent(const Range& range);

// Sorts the primitives of the range from `from` to the same rows of `to`, so that each leaf of the new tree has
// consecutive rows. A leaf has up to kSubtree primitives, or more where the cells are too coarse. Fills in `root` and
// adds the tree below it to `nodes`. Returns the leaves, in order.
// \pre has_extent(range)
std::vector<SplitNode*> split_by_grid(const BuildPrimitive* from, BuildPrimitive* to, const Range& range,
                                      const BuildSettings& settings, SplitNode& root, std::deque<SplitNodes>& nodes);

}  // namespace limn::accel
