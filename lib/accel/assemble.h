// From the binary tree to the wide one.
#pragma once

#include <span>

#include "accel/part.h"

namespace limn::accel {

// Boxes that no split by area can part: they stand beside the tree of all others.
struct Aside {
    FloatBox box;
    Part part;  // a single leaf has no node; no leaf if there are no such boxes
    double cost = 0;
};

// Halves the numbers down to leaves.
Aside set_aside(std::span<const FloatBox> boxes, std::span<const std::uint32_t> ids, const BuildSettings& settings);

// The tree may be none; `ids` are those of its references.
WideBvh assemble(const SplitNode* root, const ForestCosts& costs, std::span<const std::uint32_t> ids, Aside aside,
                 const BuildSettings& settings);

}  // namespace limn::accel
