#include "accel/assemble.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "accel/reference.h"

namespace limn::accel {

namespace {

constexpr std::uint32_t kPart = 1 << 14;  // references whose nodes one thread writes

struct Rows {
    std::uint32_t node = 0, leaf = 0, id = 0;
};

// Items are parts of the tree, depth first. At the top each has one node, which others hang from.
class Assembler {
public:
    explicit Assembler(std::span<const std::uint32_t> ids) : ids_(ids) {}

    void add_tree(const SplitNode& node) {
        if (node.size() <= kPart) {
            items_.emplace_back().whole = &node;
            return;
        }
        std::vector<const SplitNode*> children;
        fill_slots(*node.left, node.left_slots[kWidth], children);
        fill_slots(*node.right, kWidth - node.left_slots[kWidth], children);
        add_node(children, {});
    }

    // `aside` becomes the last child.
    void add_node(std::span<const SplitNode* const> children, Aside aside) {
        const std::size_t item = items_.size();
        Part& part = items_.emplace_back().part;
        PartWriter writer(ids_, part);
        writer.add_node(children);
        const bool has_aside = !aside.part.leaves.empty();
        if (has_aside) {
            set_box(part.nodes[0], children.size(), aside.box);
            part.nodes[0].child[children.size()] = aside.part.nodes.empty() ? writer.add_leaf(aside.part.ids) : 0;
            set_order(part.nodes[0]);
        }
        for (std::size_t slot = 0; slot < children.size(); ++slot) {
            if (children[slot]->is_leaf) continue;
            items_[item].links.push_back({slot, items_.size()});
            add_tree(*children[slot]);
        }
        if (has_aside && !aside.part.nodes.empty()) {
            items_[item].links.push_back({children.size(), items_.size()});
            items_.emplace_back().part = std::move(aside.part);
        }
    }

    WideBvh build() {
        for_each_item([&](Item& item) {
            if (item.whole != nullptr) PartWriter(ids_, item.part).add_tree(*item.whole);
        });
        WideBvh bvh;
        if (items_.size() == 1) {
            Part& part = items_[0].part;
            bvh.nodes = std::move(part.nodes), bvh.leaves = std::move(part.leaves), bvh.ids = std::move(part.ids);
            return bvh;
        }
        Rows next;
        for (Item& item : items_) {
            item.first = next;
            next.node += static_cast<std::uint32_t>(item.part.nodes.size());
            next.leaf += static_cast<std::uint32_t>(item.part.leaves.size());
            next.id += static_cast<std::uint32_t>(item.part.ids.size());
        }
        bvh.nodes.resize(next.node), bvh.leaves.resize(next.leaf), bvh.ids.resize(next.id);
        for_each_item([&](const Item& item) { copy(item, bvh); });
        return bvh;
    }

private:
    struct Item {
        const SplitNode* whole = nullptr;  // what is to be written
        Part part;
        struct Link {
            std::size_t slot, item;
        };
        std::vector<Link> links;  // of its first node
        Rows first;
    };

    template <class Function>
    void for_each_item(const Function& function) {
        if (items_.size() == 1) return function(items_[0]);
        tbb::parallel_for(std::size_t{0}, items_.size(), [&](std::size_t i) { function(items_[i]); });
    }

    void copy(const Item& item, WideBvh& bvh) const {
        const Part& part = item.part;
        const Rows& first = item.first;
        for (std::size_t i = 0; i < part.nodes.size(); ++i) {
            Node& node = bvh.nodes[first.node + i] = part.nodes[i];
            for (Child& child : node.child)
                if (child != kNothing) child += (child & kLeaf) != 0 ? first.leaf : first.node;
        }
        for (const auto& [slot, target] : item.links) bvh.nodes[first.node].child[slot] = items_[target].first.node;
        for (std::size_t i = 0; i < part.leaves.size(); ++i)
            bvh.leaves[first.leaf + i] = {part.leaves[i].first + first.id, part.leaves[i].count};
        std::copy(part.ids.begin(), part.ids.end(), bvh.ids.begin() + first.id);
    }

    std::span<const std::uint32_t> ids_;
    std::vector<Item> items_;
};

class Halver {
public:
    Halver(std::span<const FloatBox> boxes, const BuildSettings& settings, Aside& aside)
        : boxes_(boxes), settings_(settings), aside_(aside) {}

    // Returns the child that has them all. If one half is a leaf the other is one too, or comes later.
    Child add(std::span<const std::uint32_t> ids) {
        Part& part = aside_.part;
        if (ids.size() <= settings_.max_leaf) {
            aside_.cost += leaf_cost(static_cast<std::uint32_t>(ids.size()), settings_);
            return PartWriter({}, part).add_leaf(ids);
        }
        const auto row = static_cast<std::uint32_t>(part.nodes.size());
        part.nodes.push_back(empty_node());
        aside_.cost += settings_.node_cost;
        const std::size_t half = ids.size() / 2;
        const std::span<const std::uint32_t> halves[2] = {ids.first(half), ids.subspan(half)};
        for (std::size_t k = 0; k < 2; ++k) {
            const Child child = add(halves[k]);
            part.nodes[row].child[k] = child;
            set_box(part.nodes[row], k, around(halves[k]));
        }
        return row;
    }

    FloatBox around(std::span<const std::uint32_t> ids) const {
        Bounds all = kEmpty;
        for (const std::uint32_t id : ids) all.extend(to_bounds(boxes_[id]));
        return to_box(all);
    }

private:
    std::span<const FloatBox> boxes_;
    const BuildSettings& settings_;
    Aside& aside_;
};

}  // namespace

Aside set_aside(std::span<const FloatBox> boxes, std::span<const std::uint32_t> ids, const BuildSettings& settings) {
    Aside aside;
    if (ids.empty()) return aside;
    Halver halver(boxes, settings, aside);
    aside.box = halver.around(ids);
    halver.add(ids);
    return aside;
}

WideBvh assemble(const SplitNode* root, const ForestCosts& costs, std::span<const std::uint32_t> ids, Aside aside,
                 const BuildSettings& settings) {
    const bool has_aside = !aside.part.leaves.empty();
    if (root == nullptr && !has_aside) return {};
    double cost = root == nullptr ? 0 : costs[0] / half_area(root->box);
    Assembler assembler(ids);
    if (!has_aside && !root->is_leaf) {
        assembler.add_tree(*root);
    } else {
        std::vector<const SplitNode*> children;
        if (root != nullptr) {
            const std::size_t slots = has_aside ? kWidth - 1 : 1;
            fill_slots(*root, slots, children);
            cost = costs[slots - 1] / half_area(root->box);
        }
        cost += settings.node_cost + aside.cost;
        assembler.add_node(children, std::move(aside));
    }
    WideBvh bvh = assembler.build();
    bvh.cost = cost;
    return bvh;
}

}  // namespace limn::accel
