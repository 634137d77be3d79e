// Builds a binary tree by one thread, over build primitives that are few enough for its cache or whose centres differ
// too little for a grid.
#pragma once

#include <vector>

#include "geometry/bvh/build_primitive.h"
#include "geometry/bvh/collapse.h"

namespace limn::accel {

// The largest number of nodes on a path from the root of the binary tree to a leaf.
inline constexpr int kMaxSplitDepth = kMaxWideDepth - 2;

// Returns true if a split of the node may be arbitrarily uneven. Otherwise the node and all below it must be halved, to
// keep the depth within kMaxSplitDepth.
bool may_split(const SplitNode& node);

// The number of build primitives that one thread sorts in its second-level cache.
inline constexpr std::uint32_t kSubtree = 4096;

class SubtreeBuilder {
public:
    // `indices` receives the indices of the primitives, in the order of the leaves.
    SubtreeBuilder(const BuildSettings& settings, std::uint32_t* indices) : settings_(settings), indices_(indices) {}

    // Fills in `root`, except its depth, and builds the tree below it. The builder owns the nodes of that tree. The
    // range refers to rows of `primitives`; these rows of `primitives` and `spare` are overwritten.
    // \pre the range isn't empty, and build() hasn't been called before
    ForestCosts build(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range, SplitNode& root);

private:
    ForestCosts split(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range, SplitNode& node);

    const BuildSettings& settings_;
    std::uint32_t* indices_;
    std::vector<SplitNodes> nodes_;
};

}  // namespace limn::accel
