#include "accel/subtree.h"

#include <algorithm>
#include <utility>

#include "accel/binning.h"
#include "accel/order.h"

namespace limn::accel {

namespace {

class SubtreeBuilder {
public:
    SubtreeBuilder(const Range& range, const BuildSettings& settings)
        : first_(range.begin), settings_(settings), ids_(range.size()) {
        nodes_.reserve(range.size());
    }

    Part build(Reference* references, Reference* spare, const Range& range, int depth) {
        part_.cost = split(references, spare, range, depth)[0];
        part_.ids.reserve(range.size());
        if (nodes_[0].is_leaf) {
            add_leaf(nodes_[0]);
        } else {
            add_node(0);
        }
        return std::move(part_);
    }

private:
    ForestCosts split(Reference* references, Reference* spare, const Range& range, int depth) {
        const auto row = static_cast<std::uint32_t>(nodes_.size());
        SplitNode& node = nodes_.emplace_back();
        node.box = to_box(range.bounds);
        node.begin = range.begin - first_, node.end = range.end - first_;
        if (range.size() <= std::min(settings_.leaf_width, settings_.max_leaf)) return make_leaf(references, range);

        const Split best =
            may_split(range.size(), depth) ? best_split(references, range, settings_.leaf_width) : Split();
        if (range.size() <= settings_.max_leaf && !(best.cost < leaf_cost(range.size(), {1, settings_.leaf_width})))
            return make_leaf(references, range);
        std::uint32_t middle = range.begin + range.size() / 2;
        if (best.exists()) {
            middle = partition(references, spare, range, best);
            std::swap(references, spare);
        }
        const ForestCosts left = split(references, spare, range_over(references, range.begin, middle), depth + 1);
        const auto right_row = static_cast<std::uint32_t>(nodes_.size());
        const ForestCosts right = split(references, spare, range_over(references, middle, range.end), depth + 1);
        nodes_[row].left = row + 1, nodes_[row].right = right_row;
        return plan_node(nodes_[row], left, right, settings_);
    }

    ForestCosts make_leaf(const Reference* references, const Range& range) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) ids_[i - first_] = references[i].id();
        const SplitNode& node = nodes_.back();
        return closed_costs(half_area(node.box) * leaf_cost(range.size(), settings_));
    }

    std::uint32_t add_leaf(const SplitNode& node) {
        const auto first = static_cast<std::uint32_t>(part_.ids.size());
        part_.leaves.push_back({first, node.size()});
        part_.ids.insert(part_.ids.end(), ids_.begin() + node.begin, ids_.begin() + node.end);
        std::sort(part_.ids.begin() + first, part_.ids.end());
        return WideNode::kLeaf | static_cast<std::uint32_t>(part_.leaves.size() - 1);
    }

    std::uint32_t add_node(std::uint32_t row) {
        const auto wide_row = static_cast<std::uint32_t>(part_.nodes.size());
        part_.nodes.emplace_back();
        WideNode wide = empty_node();
        const std::size_t first = rows_.size();
        spread(nodes_, row, kWidth, rows_);
        const std::size_t count = rows_.size() - first;
        for (std::size_t slot = 0; slot < count; ++slot) {
            const SplitNode& child = nodes_[rows_[first + slot]];
            set_box(wide, slot, child.box);
            if (child.is_leaf) wide.child[slot] = add_leaf(child);
        }
        for (std::size_t slot = 0; slot < count; ++slot)
            if (!nodes_[rows_[first + slot]].is_leaf) wide.child[slot] = add_node(rows_[first + slot]);
        rows_.resize(first);
        set_order(wide);
        part_.nodes[wide_row] = wide;
        return wide_row;
    }

    std::uint32_t first_;
    const BuildSettings& settings_;
    std::vector<SplitNode> nodes_;
    std::vector<std::uint32_t> ids_;   // of the references under the nodes
    std::vector<std::uint32_t> rows_;  // a stack: of the children of wide nodes in the making
    Part part_;
};

}  // namespace

bool may_split(std::uint32_t size, int depth) {
    // After one split as uneven as can be, halving the rest takes another bit_width(size) levels at most.
    return depth + 1 + static_cast<int>(std::bit_width(size)) <= kMaxSplitDepth;
}

Part build_subtree(Reference* references, Reference* spare, const Range& range, int depth,
                   const BuildSettings& settings) {
    return SubtreeBuilder(range, settings).build(references, spare, range, depth);
}

}  // namespace limn::accel
