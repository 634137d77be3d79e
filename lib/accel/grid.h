// The upper part of a tree over many references: splits by area over the cells of a grid, instead of over bins anew at
// every level, for all levels at once with two passes over the references.
#pragma once

#include <deque>
#include <vector>

#include "accel/collapse.h"
#include "accel/reference.h"

namespace limn::accel {

// References that a node of the binary tree is left to be built of.
struct OpenRange {
    SplitNode* node;
    int depth;
    std::uint32_t begin, end;

    std::uint32_t size() const { return end - begin; }
};

// Whether its centres differ enough for a grid.
bool has_extent(const Range& range);

// Sorts the range, from one place to the same place elsewhere, into ranges of up to `enough` references if the grid's
// cells are fine enough for that. Adds the tree above these ranges under `node`. \pre has_extent(range)
std::vector<OpenRange> split_by_grid(const Reference* from, Reference* to, const Range& range, SplitNode& node,
                                     int depth, std::uint32_t enough, const BuildSettings& settings,
                                     std::deque<SplitNode>& nodes);

}  // namespace limn::accel
