// The upper part of a tree over many build primitives: splits by area over the cells of a grid, instead of over bins
// anew at every level, for all levels at once with two passes over the primitives.
#pragma once

#include <deque>
#include <vector>

#include "accel/build_primitive.h"
#include "accel/collapse.h"

namespace limn::accel {

// Build primitives that a node of the binary tree is left to be built of.
struct OpenRange {
    SplitNode* node;
    int depth;
    std::uint32_t begin, end;

    std::uint32_t size() const { return end - begin; }
};

// Whether its centres differ enough for a grid.
bool has_extent(const Range& range);

// Sorts the range, from one place to the same place elsewhere, into ranges of up to `enough` primitives if the grid's
// cells are fine enough for that. Adds the tree above these ranges under the open node. \pre has_extent(range)
std::vector<OpenRange> split_by_grid(const BuildPrimitive* from, BuildPrimitive* to, const OpenRange& open,
                                     const Range& range, std::uint32_t enough, const BuildSettings& settings,
                                     std::deque<SplitNode>& nodes);

}  // namespace limn::accel
