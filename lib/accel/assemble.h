// Puts a tree together from its parts.
#pragma once

#include <vector>

#include "accel/collapse.h"
#include "accel/subtree.h"

namespace limn::accel {

// Binary at the top; a row without children has a part of its own.
struct Tree {
    std::vector<SplitNode> nodes;  // none if there is no box
    std::vector<Part> parts;       // by row
    ForestCosts costs;             // of row 0
};

// Boxes that no split by area can part: they stand beside the tree of all others.
struct Aside {
    FloatBox box;
    Part part;  // without leaves if there are none
};

// Halves the numbers down to leaves.
Aside set_aside(std::span<const FloatBox> boxes, std::span<const std::uint32_t> ids, const BuildSettings& settings);

// Fills in all but bounds and extent.
WideBvh assemble(Tree tree, Aside aside, const BuildSettings& settings);

}  // namespace limn::accel
