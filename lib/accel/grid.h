// The upper part of a tree over many build primitives: splits by area over the cells of a grid, instead of over bins
// anew at every level, for all levels at once with two passes over the primitives.
#pragma once

#include <deque>
#include <vector>

#include "accel/build_primitive.h"
#include "accel/collapse.h"

namespace limn::accel {

// Whether its centres differ enough for a grid.
bool has_extent(const Range& range);

// Sorts the range, from one place to the same place elsewhere, into ranges of up to kSubtree primitives if the grid's
// cells are fine enough for that. Fills in `root` and adds the tree above these ranges under it; returns its leaves.
// \pre has_extent(range)
std::vector<SplitNode*> split_by_grid(const BuildPrimitive* from, BuildPrimitive* to, const Range& range,
                                      const BuildSettings& settings, SplitNode& root, std::deque<SplitNodes>& nodes);

}  // namespace limn::accel
