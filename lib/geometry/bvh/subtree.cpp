#include "geometry/bvh/subtree.h"

#include <algorithm>
#include <utility>

#include "geometry/bvh/binning.h"

namespace limn::accel {

bool may_split(const SplitNode& node) {
    // After the most uneven split, halving takes at most another bit_width(size) levels.
    return node.depth + 1 + static_cast<int>(std::bit_width(node.size())) <= kMaxSplitDepth;
}

ForestCosts SubtreeBuilder::build(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range,
                                  SplitNode& root) {
    nodes_.reserve(range.size() - 1);  // all nodes that can be needed, so they never move
    return split(primitives, spare, range, root);
}

ForestCosts SubtreeBuilder::split(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range,
                                  SplitNode& node) {
    // Fill in the node.
    node.box = range.bounds;
    node.begin = range.begin;
    node.end = range.end;
    const std::uint32_t size = range.size();
    // Find the best split.
    Split best;
    if (size > std::min(settings_.leaf_width, settings_.max_leaf) && may_split(node))
        best = best_split(primitives, range, settings_.leaf_width);
    // Make a leaf if it's cheaper.
    const double whole = leaf_cost(size, {.leaf_width = settings_.leaf_width});
    if (size <= settings_.max_leaf && !(best.cost < whole)) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) indices_[i] = primitives[i].index();
        ForestCosts costs;
        costs.fill(half_area(node.box) * leaf_cost(size, settings_));
        return costs;
    }
    // Otherwise split the range, or halve it if there is no split.
    std::uint32_t middle = range.begin + size / 2;
    if (best.exists()) {
        middle = partition(primitives, spare, range, best);
        std::swap(primitives, spare);
    }
    // Build the subtrees of both sides.
    const Range lower = range_over(primitives, range.begin, middle), upper = range_over(primitives, middle, range.end);
    auto& [left, right] = add_children(node, nodes_);
    const ForestCosts left_costs = split(primitives, spare, lower, left);
    return plan_node(node, left_costs, split(primitives, spare, upper, right), settings_);
}

}  // namespace limn::accel
