#include "accel/assemble.h"

#include <algorithm>
#include <utility>

#include "accel/parallel.h"

namespace limn::accel {

namespace {

constexpr std::uint32_t kPart = 1 << 14;  // build primitives whose nodes one thread writes

// Of the wide tree.
struct Rows {
    std::uint32_t node = 0, leaf = 0;

    void operator+=(const Rows& r) { node += r.node, leaf += r.leaf; }
};

Slots children_of(const SplitNode& node) {
    Slots children;
    fill_slots(node, kWidth, children);
    return children;
}

// All nodes and leaves stand depth first. What is at the top is written by one thread, the parts that hang from it in
// parallel, once it is known how large each is.
class Assembler {
public:
    explicit Assembler(HugeVector<std::uint32_t> indices) { bvh_.indices = std::move(indices); }

    WideBvh build(const Slots& root) {
        const bool at_top = bvh_.indices.size() > kPart;
        Rows all = count(root, at_top);
        for_all(0, parts_.size(), 1,
                [&](std::size_t i) { parts_[i].size = count(children_of(*parts_[i].root), false); });
        for (const Part& part : parts_) all += part.size;
        bvh_.nodes.resize(all.node), bvh_.leaves.resize(all.leaf);
        Rows next;
        write(root, next, at_top);
        for_all(0, parts_.size(), 1, [&](std::size_t i) {
            Rows at = parts_[i].first;
            write(children_of(*parts_[i].root), at, false);
        });
        return std::move(bvh_);
    }

private:
    struct Part {
        const SplitNode* root;
        Rows size = {}, first = {};
    };

    static bool is_part(const SplitNode& node, bool at_top) { return at_top && node.size() <= kPart; }

    // What a node with these children takes, and all that is under it. At the top parts are only noted.
    Rows count(const Slots& children, bool at_top) {
        Rows rows{1, 0};
        for (const SplitNode* child : children) {
            if (child->is_leaf)
                ++rows.leaf;
            else if (is_part(*child, at_top))
                parts_.push_back({child});
            else
                rows += count(children_of(*child), at_top);
        }
        return rows;
    }

    // Writes them from `next` on. At the top parts are only given their place.
    void write(const Slots& children, Rows& next, bool at_top) {
        FloatBox boxes[kWidth];
        for (std::size_t slot = 0; slot < children.count; ++slot) boxes[slot] = children.node[slot]->box;
        Node& node = bvh_.nodes[next.node++] = make_node({boxes, children.count});
        for (std::size_t slot = 0; slot < children.count; ++slot) {
            if (!children.node[slot]->is_leaf) continue;
            node.child[slot] = kLeaf | next.leaf;
            bvh_.leaves[next.leaf++] = leaf(*children.node[slot]);
        }
        for (std::size_t slot = 0; slot < children.count; ++slot) {
            const SplitNode& child = *children.node[slot];
            if (child.is_leaf) continue;
            node.child[slot] = next.node;
            if (!is_part(child, at_top)) {
                write(children_of(child), next, at_top);
                continue;
            }
            Part& part = parts_[next_part_++];
            part.first = next;
            next += part.size;
        }
    }

    Leaf leaf(const SplitNode& node) {
        const auto first = bvh_.indices.begin() + node.begin;
        std::sort(first, first + node.size());
        return {node.begin, node.size()};
    }

    WideBvh bvh_;
    std::vector<Part> parts_;
    std::size_t next_part_ = 0;
};

}  // namespace

WideBvh assemble(const Slots& root, HugeVector<std::uint32_t> indices) {
    return Assembler(std::move(indices)).build(root);
}

}  // namespace limn::accel
