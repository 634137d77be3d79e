#include "accel/split_tree.h"

#include <bit>

namespace limn::accel {

ForestCosts build_split_tree(std::span<Reference> references, const Range& range, int depth,
                             const BuildSettings& settings, std::vector<SplitNode>& nodes) {
    const std::size_t row = nodes.size();
    SplitNode& node = nodes.emplace_back();
    for (int a = 0; a < 3; ++a) node.lower[a] = range.bounds.lower[a], node.upper[a] = range.bounds.upper[a];
    node.begin = range.begin, node.end = range.end, node.right = 0;
    node.plan = {};
    const double area = half_area(node.lower, node.upper);
    const std::uint32_t count = range.count();
    if (count == 1) {
        node.plan.is_leaf = true;
        return leaf_costs(area, count, settings);
    }
    Range lower, upper;
    // Halving what is left takes bit_width(count - 1) levels.
    const bool deep = depth + 1 + std::bit_width(count - 1) >= kMaxSplitDepth;
    const BinMapping mapping(range);
    const Split split = deep ? Split() : best_split(references, range, mapping, settings.leaf_width);
    const float tests = static_cast<float>((count + settings.leaf_width - 1) / settings.leaf_width);
    if (count <= settings.max_leaf && !(split.cost < tests)) {
        node.plan.is_leaf = true;
        return leaf_costs(area, count, settings);
    }
    if (split.exists()) {
        partition(references, range, mapping, split, lower, upper);
    } else {
        halve(references, range, lower, upper);
    }
    const ForestCosts left = build_split_tree(references, lower, depth + 1, settings, nodes);
    nodes[row].right = static_cast<std::uint32_t>(nodes.size());
    const ForestCosts right = build_split_tree(references, upper, depth + 1, settings, nodes);
    return plan_node(area, count, left, right, settings, nodes[row].plan);
}

}  // namespace limn::accel
