#include "accel/subtree.h"

#include <algorithm>
#include <utility>

#include "accel/binning.h"

namespace limn::accel {

bool may_split(const SplitNode& node) {
    // After one split as uneven as can be, halving the rest takes another bit_width(size) levels at most.
    return node.depth + 1 + static_cast<int>(std::bit_width(node.size())) <= kMaxSplitDepth;
}

ForestCosts SubtreeBuilder::build(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range,
                                  SplitNode& root) {
    nodes_.reserve(range.size() - 1);  // no more than these: nodes do not move
    return split(primitives, spare, range, root);
}

ForestCosts SubtreeBuilder::split(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range,
                                  SplitNode& node) {
    node.box = range.bounds;
    node.begin = range.begin, node.end = range.end;
    const std::uint32_t size = range.size();
    Split best;
    if (size > std::min(settings_.leaf_width, settings_.max_leaf) && may_split(node))
        best = best_split(primitives, range, settings_.leaf_width);
    const double whole = leaf_cost(size, {.leaf_width = settings_.leaf_width});
    if (size <= settings_.max_leaf && !(best.cost < whole)) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) indices_[i] = primitives[i].index();
        ForestCosts costs;
        costs.fill(half_area(node.box) * leaf_cost(size, settings_));
        return costs;
    }
    std::uint32_t middle = range.begin + size / 2;
    if (best.exists()) {
        middle = partition(primitives, spare, range, best);
        std::swap(primitives, spare);
    }
    const Range lower = range_over(primitives, range.begin, middle), upper = range_over(primitives, middle, range.end);
    auto& [left, right] = add_children(node, nodes_);
    const ForestCosts left_costs = split(primitives, spare, lower, left);
    return plan_node(node, left_costs, split(primitives, spare, upper, right), settings_);
}

}  // namespace limn::accel
