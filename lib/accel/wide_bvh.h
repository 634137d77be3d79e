// A bounding volume hierarchy over boxes with eight children a node. It knows boxes and the indices of the primitives
// in them, nothing of these primitives.
#pragma once

#include <span>
#include <vector>

#include "accel/node.h"
#include "core/huge_pages.h"

namespace limn::accel {

struct Leaf {
    std::uint32_t first, count;  // of the indices
};

struct WideBvh {
    HugeVector<Node> nodes;             // [0] is the root, even above a single leaf; empty if nothing can be hit
    std::vector<Leaf> leaves;           // depth first; those of one node follow each other
    HugeVector<std::uint32_t> indices;  // of primitives, ascending within a leaf; those of empty boxes are left out
    double cost = 0;                    // expected, of a ray that meets the bounds of everything: see BuildSettings;
                                        // unbounded boxes count as large as all bounded ones together
};

// The surface-area heuristic: a ray that meets the root meets a node or leaf with the probability of its area over the
// root's. It pays node_cost for a node, and for a leaf leaf_cost for each leaf_width of its boxes, or part of that.
struct BuildSettings {
    std::uint32_t max_leaf = 8;    // boxes
    std::uint32_t leaf_width = 8;  // boxes tested at once
    double node_cost = 1, leaf_cost = 1;
};

// No path from the root to a leaf has more nodes.
inline constexpr int kMaxWideDepth = 64;

// Parallel in the caller's arena, the same to the bit on any number of threads. \pre fewer than 2^31 boxes
WideBvh build_wide_bvh(std::span<const FloatBox> boxes, const BuildSettings& settings = {});

}  // namespace limn::accel
