// The binary tree that becomes a wide one.
#pragma once

#include <span>
#include <vector>

#include "accel/binning.h"
#include "accel/collapse.h"

namespace limn::accel {

struct SplitNode {
    float lower[3], upper[3];
    std::uint32_t begin, end;  // of the references under it
    std::uint32_t right;       // row of the right child, the left one follows the node; 0 if it has none
    Plan plan;
};

// No path from the root has more nodes.
inline constexpr int kMaxSplitDepth = kMaxWideDepth - 2;

// Sorts the references into a tree, appended to `nodes`. \pre the range is not empty
ForestCosts build_split_tree(std::span<Reference> references, const Range& range, int depth,
                             const BuildSettings& settings, std::vector<SplitNode>& nodes);

}  // namespace limn::accel
