// Which nodes of a binary tree become nodes and leaves of the wide one, at least cost, by dynamic programming (Ylitie,
// Karras, Laine: Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, 2017, section 3).
#pragma once

#include <array>

#include "accel/wide_bvh.h"

namespace limn::accel {

// The least cost of what stands under a binary node, times the root's area, if it may fill up to i + 1 slots.
using ForestCosts = std::array<double, kWidth - 1>;

// How to get there.
struct Plan {
    std::uint8_t left_slots[kWidth - 1] = {};  // of i + 2 slots, how many go to the left child
    std::uint8_t open_from = kWidth;           // with fewer slots the node fills one, by itself
    bool is_leaf = false;                      // what it is then
};

double half_area(const float* lower, const float* upper);

// For a binary leaf, or what may become one: nothing below it is of use.
ForestCosts leaf_costs(double area, std::uint32_t count, const BuildSettings& settings);

// For a node of `count` boxes, or of more than max_leaf, with two children.
ForestCosts plan_node(double area, std::uint32_t count, const ForestCosts& left, const ForestCosts& right,
                      const BuildSettings& settings, Plan& plan);

}  // namespace limn::accel
