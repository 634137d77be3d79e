// A node of a tree as the builder makes it and traversal reads it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace limn::accel {

// Closed; the caller rounds it outward. Sides may be infinite; it is empty where lower <= upper fails on an axis.
struct FloatBox {
    float lower[3], upper[3];
};

inline constexpr std::size_t kWidth = 8;

// What a node refers to: another node, by its row; a leaf; or nothing.
using Child = std::uint32_t;
inline constexpr Child kLeaf = 0x80000000u;  // bit: the rest is the leaf's row, or where it is stored
inline constexpr Child kNothing = 0xffffffffu;

// Present children come first.
struct alignas(64) Node {
    float planes[6][kWidth];  // of the children: lower x y z, upper x y z; of an absent one +infinity and -infinity
    Child child[kWidth];
    // By the signs of a ray's direction, bit a for a negative direction[a]: the children as such rays tend to meet
    // them, by where their centres lie along the octant's diagonal; four bits each, the FARTHEST lowest, absent ones
    // first.
    std::uint32_t order[kWidth];
};
static_assert(sizeof(Node) == 256);

}  // namespace limn::accel
