// Writes the nodes and leaves of the wide tree.
#pragma once

#include <span>
#include <vector>

#include "accel/collapse.h"

namespace limn::accel {

// Some nodes and leaves of a tree, depth first; rows count from the part's own first ones.
struct Part {
    HugeVector<Node> nodes;
    std::vector<Leaf> leaves;
    std::vector<std::uint32_t> ids;
};

class PartWriter {
public:
    // `ids`: of the references that split nodes count.
    PartWriter(std::span<const std::uint32_t> ids, Part& part) : ids_(ids), part_(part) {}

    // Writes the node and all that is under it.
    void add_tree(const SplitNode& node);

    // Writes one node over the given ones, and those that are leaves. Inner children have child 0 for the time being.
    void add_node(std::span<const SplitNode* const> children);

    // Returns the child that it becomes.
    Child add_leaf(std::span<const std::uint32_t> ids);

private:
    std::span<const std::uint32_t> ids_;
    Part& part_;
    std::vector<const SplitNode*> children_;  // a stack: of the nodes in the making
};

}  // namespace limn::accel
