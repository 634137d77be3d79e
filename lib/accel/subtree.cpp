#include "accel/subtree.h"

#include <algorithm>
#include <utility>

#include "accel/binning.h"

namespace limn::accel {

bool may_split(std::uint32_t size, int depth) {
    // After one split as uneven as can be, halving the rest takes another bit_width(size) levels at most.
    return depth + 1 + static_cast<int>(std::bit_width(size)) <= kMaxSplitDepth;
}

ForestCosts SubtreeBuilder::build(Reference* references, Reference* spare, const Range& range, int depth,
                                  SplitNode& root) {
    nodes_.reserve(2 * std::size_t{range.size()} - 2);  // no more: nodes do not move
    return split(references, spare, range, depth, root);
}

ForestCosts SubtreeBuilder::split(Reference* references, Reference* spare, const Range& range, int depth,
                                  SplitNode& node) {
    node.box = to_box(range.bounds);
    node.begin = range.begin, node.end = range.end;
    if (range.size() <= std::min(settings_.leaf_width, settings_.max_leaf)) return make_leaf(references, node);

    Split best;
    if (may_split(range.size(), depth)) best = best_split(references, range, settings_.leaf_width);
    const double whole = leaf_cost(range.size(), {.leaf_width = settings_.leaf_width});
    if (range.size() <= settings_.max_leaf && !(best.cost < whole)) return make_leaf(references, node);

    std::uint32_t middle = range.begin + range.size() / 2;
    if (best.exists()) {
        middle = partition(references, spare, range, best);
        std::swap(references, spare);
    }
    node.left = &nodes_.emplace_back();
    const ForestCosts left =
        split(references, spare, range_over(references, range.begin, middle), depth + 1, *node.left);
    node.right = &nodes_.emplace_back();
    const ForestCosts right =
        split(references, spare, range_over(references, middle, range.end), depth + 1, *node.right);
    return plan_node(node, left, right, settings_);
}

ForestCosts SubtreeBuilder::make_leaf(const Reference* references, const SplitNode& node) {
    for (std::uint32_t i = node.begin; i < node.end; ++i) ids_[i] = references[i].id();
    return closed_costs(half_area(node.box) * leaf_cost(node.size(), settings_));
}

}  // namespace limn::accel
