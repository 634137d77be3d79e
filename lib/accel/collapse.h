// Which nodes of a binary tree become nodes and leaves of the wide one, at least cost, by dynamic programming (Ylitie,
// Karras, Laine: Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, 2017, section 3).
#pragma once

#include <array>

#include "accel/build_primitive.h"

namespace limn::accel {

struct SplitNode {
    Bounds box = kEmpty;
    std::uint32_t begin = 0, end = 0;  // of the primitives under it
    std::array<SplitNode, 2>* children = nullptr;
    // The plan: if all that is under the node may fill so many slots, two or more, how many of them its left child
    // gets; and with fewer than `open_from` the node fills one, by itself, as a node or a leaf.
    std::uint8_t left_slots[kWidth + 1] = {};
    std::uint8_t open_from = kWidth + 1;
    bool is_leaf = true;
    std::uint8_t depth = 1;  // of nodes on the way to it, itself included

    std::uint32_t size() const { return end - begin; }
};
using SplitNodes = std::array<SplitNode, 2>;

// `nodes` must not move them.
template <class Nodes>
SplitNodes& add_children(SplitNode& node, Nodes& nodes) {
    node.children = &nodes.emplace_back();
    for (SplitNode& child : *node.children) child.depth = static_cast<std::uint8_t>(node.depth + 1);
    return *node.children;
}

// The children of a wide node.
struct Slots {
    const SplitNode* node[kWidth];
    std::size_t count = 0;

    // Adds the nodes that make the most of so many slots for all that is under `root`.
    void add(const SplitNode& root, std::size_t slots);

    const SplitNode* const* begin() const { return node; }
    const SplitNode* const* end() const { return node + count; }
};

// The least cost of what is under a binary node, times the root's area, if it may fill up to i + 1 slots.
using ForestCosts = std::array<double, kWidth - 1>;

double half_area(const Bounds& box);
double leaf_cost(std::uint32_t size, const BuildSettings& settings);

// Makes the plan of a node with two children.
ForestCosts plan_node(SplitNode& node, const ForestCosts& left, const ForestCosts& right,
                      const BuildSettings& settings);

// All but the cost of the tree whose root has these children. `indices`: of the primitives that split nodes count.
WideBvh assemble(const Slots& root, HugeVector<std::uint32_t> indices);

}  // namespace limn::accel
