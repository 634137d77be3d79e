// A bounding volume hierarchy (BVH) with eight children a node. It is built from boxes alone; primitives appear only as
// the indices of their boxes.
#pragma once

#include <span>
#include <vector>

#include "geometry/bvh/node.h"
#include "math/system/huge_pages.h"

namespace limn::accel {

// The primitives of a leaf: `count` entries of WideBvh::indices from `first` on.
struct Leaf {
    std::uint32_t first, count;
};

struct WideBvh {
    HugeVector<Node> nodes;             // [0] is the root, even above a single leaf; empty if all boxes are empty
    std::vector<Leaf> leaves;           // depth first; the leaves of one node are consecutive
    HugeVector<std::uint32_t> indices;  // primitives in the order of the leaves, ascending in each; without empty boxes

    // The expected cost of a ray that intersects the bounds of the whole tree, in the units of BuildSettings. An
    // unbounded box is counted as if it were as large as the bounds of all bounded ones.
    double cost = 0;
};

// Parameters of the surface-area heuristic. A ray that intersects the root intersects a node or leaf with probability
// area / area of the root. A visit of a node costs node_cost. A visit of a leaf costs leaf_cost for each group of up to
// leaf_width boxes.
struct BuildSettings {
    std::uint32_t max_leaf = 8;    // most boxes of a leaf
    std::uint32_t leaf_width = 8;  // boxes tested at once
    double node_cost = 1, leaf_cost = 1;
};

// The largest number of nodes on a path from the root to a leaf.
inline constexpr int kMaxWideDepth = 64;

// Builds the tree, in parallel in the caller's arena. The result is the same to the bit for any number of threads.
// \pre there are fewer than 2^31 boxes
WideBvh build_wide_bvh(std::span<const FloatBox> boxes, const BuildSettings& settings = {});

}  // namespace limn::accel
