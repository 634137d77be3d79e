#include "accel/part.h"

#include <algorithm>

namespace limn::accel {

void PartWriter::add_tree(const SplitNode& node) {
    const std::size_t row = part_.nodes.size(), first = children_.size();
    fill_slots(*node.left, node.left_slots[kWidth], children_);
    fill_slots(*node.right, kWidth - node.left_slots[kWidth], children_);
    const std::size_t count = children_.size() - first;
    add_node(std::span(children_).subspan(first));
    for (std::size_t slot = 0; slot < count; ++slot) {
        const SplitNode& child = *children_[first + slot];
        if (child.is_leaf) continue;
        part_.nodes[row].child[slot] = static_cast<std::uint32_t>(part_.nodes.size());
        add_tree(child);
    }
    children_.resize(first);
}

void PartWriter::add_node(std::span<const SplitNode* const> children) {
    Node& wide = part_.nodes.emplace_back(empty_node());
    for (std::size_t slot = 0; slot < children.size(); ++slot) {
        const SplitNode& child = *children[slot];
        set_box(wide, slot, child.box);
        wide.child[slot] = child.is_leaf ? add_leaf(ids_.subspan(child.begin, child.size())) : 0;
    }
    set_order(wide);
}

Child PartWriter::add_leaf(std::span<const std::uint32_t> ids) {
    const auto first = static_cast<std::uint32_t>(part_.ids.size());
    part_.ids.insert(part_.ids.end(), ids.begin(), ids.end());
    std::sort(part_.ids.begin() + first, part_.ids.end());
    // The halves of a box that was cut may meet again.
    part_.ids.erase(std::unique(part_.ids.begin() + first, part_.ids.end()), part_.ids.end());
    part_.leaves.push_back({first, static_cast<std::uint32_t>(part_.ids.size()) - first});
    return kLeaf | static_cast<std::uint32_t>(part_.leaves.size() - 1);
}

}  // namespace limn::accel
