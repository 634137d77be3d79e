#include "accel/assemble.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "accel/order.h"

namespace limn::accel {

namespace {

struct Rows {
    std::uint32_t node = 0, leaf = 0, id = 0;
};

class Assembler {
public:
    explicit Assembler(const Tree& tree) : tree_(tree) {}

    // A node over rows of the binary tree, and perhaps what stands aside.
    std::uint32_t add_node(const std::vector<std::uint32_t>& rows, const Aside& aside) {
        const std::uint32_t number = next_.node++;
        WideNode wide = empty_node();
        std::size_t slot = 0;
        for (; slot < rows.size(); ++slot) {
            const SplitNode& child = tree_.nodes[rows[slot]];
            set_box(wide, slot, child.box);
            if (child.is_leaf) wide.child[slot] = add_part(tree_.parts[rows[slot]]);  // top nodes have parts below
        }
        if (!aside.part.leaves.empty()) {
            set_box(wide, slot, aside.box);
            if (aside.part.nodes.empty()) wide.child[slot] = add_part(aside.part);
        }
        for (slot = 0; slot < rows.size(); ++slot)
            if (!tree_.nodes[rows[slot]].is_leaf) wide.child[slot] = add_inner(rows[slot]);
        if (!aside.part.nodes.empty()) wide.child[slot] = add_part(aside.part);
        set_order(wide);
        top_.push_back({number, wide});
        return number;
    }

    WideBvh build() {
        WideBvh bvh;
        bvh.nodes.resize(next_.node);
        bvh.leaves.resize(next_.leaf);
        bvh.ids.resize(next_.id);
        for (const auto& [row, node] : top_) bvh.nodes[row] = node;
        tbb::parallel_for(std::size_t{0}, placed_.size(), [&](std::size_t i) { copy(placed_[i], bvh); });
        return bvh;
    }

private:
    struct Placed {
        const Part* part;
        Rows rows;
    };

    std::uint32_t add_inner(std::uint32_t row) {
        if (tree_.nodes[row].right == 0) return add_part(tree_.parts[row]);
        std::vector<std::uint32_t> rows;
        spread(tree_.nodes, row, kWidth, rows);
        return add_node(rows, {});
    }

    std::uint32_t add_part(const Part& part) {
        placed_.push_back({&part, next_});
        const std::uint32_t child = part.nodes.empty() ? WideNode::kLeaf | next_.leaf : next_.node;
        next_.node += static_cast<std::uint32_t>(part.nodes.size());
        next_.leaf += static_cast<std::uint32_t>(part.leaves.size());
        next_.id += static_cast<std::uint32_t>(part.ids.size());
        return child;
    }

    static void copy(const Placed& placed, WideBvh& bvh) {
        const auto& [part, rows] = placed;
        for (std::size_t i = 0; i < part->nodes.size(); ++i) {
            WideNode& node = bvh.nodes[rows.node + i] = part->nodes[i];
            for (std::uint32_t& child : node.child)
                if (child != WideNode::kAbsent) child += (child & WideNode::kLeaf) != 0 ? rows.leaf : rows.node;
        }
        for (std::size_t i = 0; i < part->leaves.size(); ++i)
            bvh.leaves[rows.leaf + i] = {part->leaves[i].first + rows.id, part->leaves[i].count};
        std::copy(part->ids.begin(), part->ids.end(), bvh.ids.begin() + rows.id);
    }

    const Tree& tree_;
    std::vector<std::pair<std::uint32_t, WideNode>> top_;
    std::vector<Placed> placed_;
    Rows next_;
};

// Returns the child that has all of it. Leaves of one node follow each other, for halves that differ by one are both
// leaves, or the larger one is the lower.
class Halver {
public:
    Halver(std::span<const FloatBox> boxes, const BuildSettings& settings, Part& part)
        : boxes_(boxes), settings_(settings), part_(part) {}

    std::uint32_t add(std::span<const std::uint32_t> ids) {
        if (ids.size() <= settings_.max_leaf) {
            const auto size = static_cast<std::uint32_t>(ids.size());
            part_.leaves.push_back({static_cast<std::uint32_t>(part_.ids.size()), size});
            part_.ids.insert(part_.ids.end(), ids.begin(), ids.end());
            part_.cost += leaf_cost(size, settings_);
            return WideNode::kLeaf | static_cast<std::uint32_t>(part_.leaves.size() - 1);
        }
        const auto row = static_cast<std::uint32_t>(part_.nodes.size());
        part_.nodes.push_back(empty_node());
        part_.cost += settings_.node_cost;
        const std::size_t half = ids.size() / 2;
        const std::span<const std::uint32_t> halves[2] = {ids.first(half), ids.subspan(half)};
        for (std::size_t k = 0; k < 2; ++k) {
            const std::uint32_t child = add(halves[k]);
            part_.nodes[row].child[k] = child;
            set_box(part_.nodes[row], k, around(halves[k]));
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
    Part& part_;
};

}  // namespace

Aside set_aside(std::span<const FloatBox> boxes, std::span<const std::uint32_t> ids, const BuildSettings& settings) {
    Aside aside;
    if (ids.empty()) return aside;
    Halver halver(boxes, settings, aside.part);
    aside.box = halver.around(ids);
    halver.add(ids);
    return aside;
}

WideBvh assemble(Tree tree, Aside aside, const BuildSettings& settings) {
    WideBvh bvh;
    const bool any_aside = !aside.part.leaves.empty();
    if (tree.nodes.empty() && !any_aside) return bvh;
    const bool lone = tree.nodes.size() == 1;
    if (lone && !tree.nodes[0].is_leaf && !any_aside) {  // one part is all there is
        Part& part = tree.parts[0];
        bvh.nodes = std::move(part.nodes), bvh.leaves = std::move(part.leaves), bvh.ids = std::move(part.ids);
        bvh.cost = part.cost / half_area(tree.nodes[0].box);
        return bvh;
    }
    std::vector<std::uint32_t> rows;
    const std::size_t slots = any_aside ? kWidth - 1 : kWidth;
    const bool open = !lone && !tree.nodes.empty() && (!any_aside || slots >= tree.nodes[0].open_from);
    if (open) {
        spread(tree.nodes, 0, slots, rows);
    } else if (!tree.nodes.empty()) {
        rows.push_back(0);
    }
    Assembler assembler(tree);
    assembler.add_node(rows, aside);
    bvh = assembler.build();
    if (!tree.nodes.empty()) bvh.cost = tree.costs[any_aside ? kWidth - 2 : 0] / half_area(tree.nodes[0].box);
    if (any_aside || lone) bvh.cost += settings.node_cost;
    bvh.cost += aside.part.cost;
    return bvh;
}

}  // namespace limn::accel
