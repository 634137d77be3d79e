// Which nodes of a binary tree become nodes and leaves of the wide one, at least cost, by dynamic programming (Ylitie,
// Karras, Laine: Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, 2017, section 3).
#pragma once

#include <array>

#include "accel/wide_bvh.h"

namespace limn::accel {

struct SplitNode {
    FloatBox box;
    std::uint32_t begin = 0, end = 0;  // of the primitives under it
    SplitNode *left = nullptr, *right = nullptr;
    // The plan: if all that is under the node may fill so many slots, two or more, how many of them its left child
    // gets; and with fewer than `open_from` the node fills one, by itself, as a node or a leaf.
    std::uint8_t left_slots[kWidth + 1] = {};
    std::uint8_t open_from = kWidth + 1;
    bool is_leaf = true;

    std::uint32_t size() const { return end - begin; }
};

// The children of a wide node.
struct Slots {
    const SplitNode* node[kWidth];
    std::size_t count = 0;

    void add(const SplitNode& child) { node[count++] = &child; }
    const SplitNode* const* begin() const { return node; }
    const SplitNode* const* end() const { return node + count; }
};

// The least cost of what is under a binary node, times the root's area, if it may fill up to i + 1 slots.
using ForestCosts = std::array<double, kWidth - 1>;

double half_area(const FloatBox& box);
double leaf_cost(std::uint32_t size, const BuildSettings& settings);

// Of what fills one slot, whatever it is offered.
ForestCosts closed_costs(double cost);

// Makes the plan of a node with two children.
ForestCosts plan_node(SplitNode& node, const ForestCosts& left, const ForestCosts& right,
                      const BuildSettings& settings);

// Adds the nodes that make the most of so many slots for all that is under `node`.
void fill_slots(const SplitNode& node, std::size_t slots, Slots& filled);

}  // namespace limn::accel
