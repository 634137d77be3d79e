// The binary tree over build primitives few enough for one thread and its cache, or whose centres no grid tells apart.
#pragma once

#include <vector>

#include "accel/build_primitive.h"
#include "accel/collapse.h"

namespace limn::accel {

// No path in the binary tree has more nodes.
inline constexpr int kMaxSplitDepth = kMaxWideDepth - 2;

// Whether a split may be as uneven as it likes, or boxes must be halved from here on for the depth to stay within its
// limit.
bool may_split(const SplitNode& node);

// Build primitives that one thread sorts, in its second-level cache.
inline constexpr std::uint32_t kSubtree = 4096;

class SubtreeBuilder {
public:
    // `indices` gets those of the primitives, at their places in the tree.
    SubtreeBuilder(const BuildSettings& settings, std::uint32_t* indices) : settings_(settings), indices_(indices) {}

    // Fills in `root`, but for its depth, and adds what is under it. `primitives` has what is in the range; both it and
    // `spare`, of the same rows, are used up. \pre the range is not empty; once only
    ForestCosts build(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range, SplitNode& root);

private:
    ForestCosts split(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range, SplitNode& node);

    const BuildSettings& settings_;
    std::uint32_t* indices_;
    std::vector<SplitNodes> nodes_;
};

}  // namespace limn::accel
