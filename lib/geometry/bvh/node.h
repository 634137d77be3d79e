// A node of the tree. The builder writes it, and traversal reads it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace limn::accel {

// A closed box. The code that makes a box rounds it outward. Coordinates may be infinite. A box is empty if lower <=
// upper fails on any axis.
struct FloatBox {
    float lower[3], upper[3];
};

inline constexpr std::size_t kWidth = 8;  // children of a node

// A reference from a node to its child: the row of another node, a leaf, or kNothing.
using Child = std::uint32_t;
inline constexpr Child kLeaf = 0x80000000u;  // flag of a leaf; the other bits are its row or its place in the blocks
inline constexpr Child kNothing = 0xffffffffu;

// The boxes of up to eight children. Absent children come last.
struct alignas(64) Node {
    float planes[6][kWidth];  // lower x y z, upper x y z of each child; +infinity and -infinity for an absent one
    Child child[kWidth];
    // For each octant of ray directions, the children from far to near, four bits each, from the lowest bits on. Bit a
    // of the octant is set if direction[a] is negative. Children are ordered by the projection of their centres onto
    // the octant's diagonal. Absent children count as the farthest.
    std::uint32_t order[kWidth];
};
static_assert(sizeof(Node) == 256);

}  // namespace limn::accel
