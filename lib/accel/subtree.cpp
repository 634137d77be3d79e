#include "accel/subtree.h"

#include <algorithm>
#include <utility>

#include "accel/binning.h"

namespace limn::accel {

bool may_split(std::uint32_t size, int depth) {
    // After one split as uneven as can be, halving the rest takes another bit_width(size) levels at most.
    return depth + 1 + static_cast<int>(std::bit_width(size)) <= kMaxSplitDepth;
}

ForestCosts SubtreeBuilder::build(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range, int depth,
                                  SplitNode& root) {
    nodes_.reserve(2 * std::size_t{range.size()} - 2);  // no more than these: nodes do not move
    return split(primitives, spare, range, depth, root);
}

ForestCosts SubtreeBuilder::split(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range, int depth,
                                  SplitNode& node) {
    node.box = to_box(range.bounds);
    node.begin = range.begin, node.end = range.end;
    const std::uint32_t size = range.size();
    Split best;
    if (size > std::min(settings_.leaf_width, settings_.max_leaf) && may_split(size, depth))
        best = best_split(primitives, range, settings_.leaf_width);
    const double whole = leaf_cost(size, {.leaf_width = settings_.leaf_width});
    if (size <= settings_.max_leaf && !(best.cost < whole)) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) indices_[i] = primitives[i].index();
        return closed_costs(half_area(node.box) * leaf_cost(size, settings_));
    }
    std::uint32_t middle = range.begin + size / 2;
    if (best.exists()) {
        middle = partition(primitives, spare, range, best);
        std::swap(primitives, spare);
    }
    const Range lower = range_over(primitives, range.begin, middle), upper = range_over(primitives, middle, range.end);
    node.left = &nodes_.emplace_back();
    const ForestCosts left = split(primitives, spare, lower, depth + 1, *node.left);
    node.right = &nodes_.emplace_back();
    const ForestCosts right = split(primitives, spare, upper, depth + 1, *node.right);
    return plan_node(node, left, right, settings_);
}

}  // namespace limn::accel
