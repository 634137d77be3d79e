// Collapses a binary tree into a wide one. Dynamic programming finds the nodes of the binary tree that become nodes and
// leaves of the wide tree at the least expected cost (Ylitie, Karras, Laine: Efficient Incoherent Ray Traversal on GPUs
// Through Compressed Wide BVHs, 2017, section 3).
#pragma once

#include <array>

#include "geometry/bvh/build_primitive.h"

namespace limn::accel {

// A node of the binary tree. A slot is the place of a child in a wide node.
struct SplitNode {
    Bounds box = kEmpty;
    std::uint32_t begin = 0, end = 0;  // the primitives under the node
    std::array<SplitNode, 2>* children = nullptr;

    // The plan, which plan_node() makes. If the subtree may fill n slots and n < open_from, the node itself fills one
    // slot, as a wide node or a leaf. Otherwise the subtree of its left child gets left_slots[n] of the n slots, and
    // that of its right child gets the rest.
    std::uint8_t left_slots[kWidth + 1] = {};
    std::uint8_t open_from = kWidth + 1;

    bool is_leaf = true;
    std::uint8_t depth = 1;  // number of nodes from the root to this one, both included

    std::uint32_t size() const { return end - begin; }
};
using SplitNodes = std::array<SplitNode, 2>;

// Adds two children to `nodes` and links them to `node`. `nodes` must keep its elements at their addresses.
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

    // Adds the nodes that the plan puts into up to `slots` slots for the subtree of `root`.
    void add(const SplitNode& root, std::size_t slots);

    const SplitNode* const* begin() const { return node; }
    const SplitNode* const* end() const { return node + count; }
};

// The least costs of the subtree of a binary node, times the area of the root. Element i is the cost if the subtree may
// fill up to i + 1 slots.
using ForestCosts = std::array<double, kWidth - 1>;

// Returns half the area of the box and a little more. The addition makes boxes without area differ by their length, and
// keeps the area of the root above 0.
double half_area(const Bounds& box);

// Returns the cost of a visit of a leaf with `size` boxes.
double leaf_cost(std::uint32_t size, const BuildSettings& settings);

// Makes the plan of a node with two children from the costs of their subtrees. Returns the costs of its own subtree.
ForestCosts plan_node(SplitNode& node, const ForestCosts& left, const ForestCosts& right,
                      const BuildSettings& settings);

// Returns a node with the boxes and the orders of its children. Their references are set later.
Node node_over(const Slots& children);

// Returns the wide tree whose root has these children, all but its cost. `indices` are the indices of the primitives,
// in the order in which split nodes refer to them.
WideBvh assemble(const Slots& root, HugeVector<std::uint32_t> indices);

}  // namespace limn::accel
