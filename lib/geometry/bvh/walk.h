// Traversal of a tree with one ray, for trees over objects that are intersected by virtual functions.
#pragma once

#include <utility>

#include "geometry/bvh/slab.h"
#include "geometry/bvh/wide_bvh.h"

namespace limn::accel {

// Calls visit(index) for every primitive of every leaf whose box the ray intersects up to t_max, nearer children first.
// visit() returns the new t_max. The coordinates of the tree's boxes are those of the ray's space times `scale`, a
// power of two.
template <class Visit>
void for_each_met(const WideBvh& bvh, double scale, const SlabRay& slab, double t_max, const Visit& visit) {
    if (bvh.nodes.empty()) return;
    struct Entry {
        Child child;
        double near;
    } stack[(kWidth - 1) * kMaxWideDepth + 1];
    stack[0] = {0, slab.t_min};
    int size = 1;
    const double unscale = 1 / scale;
    while (size > 0) {
        const Entry entry = stack[--size];
        if (slab.is_beyond(entry.near, t_max)) continue;
        // Visit the primitives of a leaf.
        if ((entry.child & kLeaf) != 0) {
            const Leaf leaf = bvh.leaves[entry.child & ~kLeaf];
            for (std::uint32_t i = 0; i < leaf.count; ++i) t_max = visit(bvh.indices[leaf.first + i]);
            continue;
        }
        // Push the children that the ray intersects, the nearest on top.
        const Node& node = bvh.nodes[entry.child];
        const int first = size;
        for (std::size_t slot = 0; slot < kWidth && node.child[slot] != kNothing; ++slot) {
            double lower[3], upper[3], near = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                lower[a] = unscale * static_cast<double>(node.planes[a][slot]);
                upper[a] = unscale * static_cast<double>(node.planes[3 + a][slot]);
            }
            if (!slab.meets(lower, upper, t_max, near)) continue;
            int at = size++;
            for (; at > first && stack[at - 1].near < near; --at) stack[at] = stack[at - 1];
            stack[at] = {node.child[slot], near};
        }
    }
}

}  // namespace limn::accel
