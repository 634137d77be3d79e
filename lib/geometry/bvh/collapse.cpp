#include "geometry/bvh/collapse.h"

#include <algorithm>
#include <limits>

namespace limn::accel {

double half_area(const Bounds& box) {
    double side[3];
    for (int a = 0; a < 3; ++a) side[a] = static_cast<double>(box.upper[a]) - box.lower[a];
    const double square = side[0] * side[0] + side[1] * side[1] + side[2] * side[2];
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0] + 0x1p-20 * square + 0x1p-400;
}

double leaf_cost(std::uint32_t size, const BuildSettings& settings) {
    return (size + settings.leaf_width - 1) / settings.leaf_width * settings.leaf_cost;
}

ForestCosts plan_node(SplitNode& node, const ForestCosts& left, const ForestCosts& right,
                      const BuildSettings& settings) {
    // Find the cheapest way to share n slots between the children.
    double open[kWidth + 1];
    for (std::size_t slots = 2; slots <= kWidth; ++slots) {
        open[slots] = std::numeric_limits<double>::infinity();
        for (std::size_t k = 1; k < slots; ++k) {
            const double cost = left[k - 1] + right[slots - k - 1];
            if (cost < open[slots]) {
                open[slots] = cost;
                node.left_slots[slots] = static_cast<std::uint8_t>(k);
            }
        }
    }
    // Find the cost of a single slot, filled by a wide node or a leaf.
    const double area = half_area(node.box);
    double closed = open[kWidth] + area * settings.node_cost;
    node.is_leaf = false;
    if (node.size() <= settings.max_leaf) {
        const double leaf = area * leaf_cost(node.size(), settings);
        node.is_leaf = leaf <= closed;
        closed = std::min(leaf, closed);
    }
    // Find the number of slots from which sharing them is cheaper. More slots never cost more.
    ForestCosts costs;
    costs[0] = closed;
    node.open_from = node.is_leaf ? kWidth + 1 : kWidth;
    for (std::size_t slots = kWidth - 1; slots >= 2; --slots) {
        if (open[slots] < closed) node.open_from = static_cast<std::uint8_t>(slots);
        costs[slots - 1] = std::min(open[slots], closed);
    }
    return costs;
}

void Slots::add(const SplitNode& root, std::size_t slots) {
    if (slots < root.open_from) {
        node[count++] = &root;
        return;
    }
    const auto& [left, right] = *root.children;
    add(left, root.left_slots[slots]);
    add(right, slots - root.left_slots[slots]);
}

}  // namespace limn::accel
