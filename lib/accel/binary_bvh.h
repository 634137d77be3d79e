// A bounding volume hierarchy over boxes. It knows boxes and their numbers, nothing of what is in them; the described
// `Bvh` and the compiled scene are both built by it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "accel/slab.h"
#include "limn/core/box.h"

namespace limn::accel {

struct BinaryNode {
    Box bounds;
    std::uint32_t first = 0;  // leaf: first of its ids; inner: its left child, the right one follows it
    std::uint32_t count = 0;  // leaf: how many ids; inner: 0
};
static_assert(sizeof(BinaryNode) == 56);

struct BinaryBvh {
    std::vector<BinaryNode> nodes;   // [0] is the root; empty if nothing can be hit
    std::vector<std::uint32_t> ids;  // of the boxes, permuted; empty boxes are left out
    double extent = 0;               // the largest finite coordinate of a box

    Box bounds() const { return nodes.empty() ? Box{} : nodes.front().bounds; }
};

// No path from the root is longer.
inline constexpr int kMaxDepth = 96;

// Deterministic. Surface-area heuristic over bins (Wald, On Fast Construction of SAH-based Bounding Volume Hierarchies,
// 2007).
BinaryBvh build_binary_bvh(std::span<const Box> boxes);

// Calls `visit(id)` for every id in a leaf that the ray meets, nearer children first, up to t_max. `visit` returns the
// t beyond which the rest does not matter.
template <class Visit>
void for_each_met(const BinaryBvh& bvh, const SlabRay& slab, double t_max, const Visit& visit) {
    if (bvh.nodes.empty()) return;
    struct Entry {
        std::uint32_t node;
        double near;
    } stack[kMaxDepth + 1];
    int size = 0;
    const auto push = [&](std::uint32_t node) {
        double near = 0;
        if (slab.meets(bvh.nodes[node].bounds, t_max, near)) stack[size++] = {node, near};
    };
    push(0);
    while (size > 0) {
        const Entry entry = stack[--size];
        if (slab.is_beyond(entry.near, t_max)) continue;
        const BinaryNode& node = bvh.nodes[entry.node];
        if (node.count > 0) {
            for (std::uint32_t i = 0; i < node.count; ++i) t_max = visit(bvh.ids[node.first + i]);
            continue;
        }
        const int before = size;
        push(node.first);
        push(node.first + 1);
        if (size - before == 2 && stack[size - 1].near > stack[size - 2].near)
            std::swap(stack[size - 1], stack[size - 2]);
    }
}

}  // namespace limn::accel
