#include "accel/collapse.h"

#include <algorithm>
#include <limits>

namespace limn::accel {

double half_area(const FloatBox& box) {
    double side[3];
    for (std::size_t a = 0; a < 3; ++a) side[a] = static_cast<double>(box.upper[a]) - box.lower[a];
    // A little more, so that boxes without any area are told apart by their length, and no root has none.
    const double square = side[0] * side[0] + side[1] * side[1] + side[2] * side[2];
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0] + 0x1p-20 * square + 0x1p-400;
}

double leaf_cost(std::uint32_t size, const BuildSettings& settings) {
    return (size + settings.leaf_width - 1) / settings.leaf_width * settings.leaf_cost;
}

ForestCosts closed_costs(double cost) {
    ForestCosts costs;
    costs.fill(cost);
    return costs;
}

ForestCosts plan_node(SplitNode& node, const ForestCosts& left, const ForestCosts& right,
                      const BuildSettings& settings) {
    double open[kWidth + 1];  // over so many slots
    for (std::size_t slots = 2; slots <= kWidth; ++slots) {
        open[slots] = std::numeric_limits<double>::infinity();
        for (std::size_t k = 1; k < slots; ++k) {
            const double cost = left[k - 1] + right[slots - k - 1];
            if (cost < open[slots]) open[slots] = cost, node.left_slots[slots] = static_cast<std::uint8_t>(k);
        }
    }
    const double area = half_area(node.box);
    double closed = open[kWidth] + area * settings.node_cost;
    node.is_leaf = false;
    if (node.size() <= settings.max_leaf) {
        const double leaf = area * leaf_cost(node.size(), settings);
        node.is_leaf = leaf <= closed;
        closed = std::min(leaf, closed);
    }
    // More slots never cost more.
    ForestCosts costs;
    costs[0] = closed;
    node.open_from = kWidth;
    for (std::size_t slots = kWidth - 1; slots >= 2; --slots) {
        if (open[slots] < closed) node.open_from = static_cast<std::uint8_t>(slots);
        costs[slots - 1] = std::min(open[slots], closed);
    }
    return costs;
}

void spread(const std::vector<SplitNode>& nodes, std::uint32_t row, std::size_t slots,
            std::vector<std::uint32_t>& rows) {
    const auto place = [&](std::uint32_t child, std::size_t its_slots) {
        if (its_slots < nodes[child].open_from) {
            rows.push_back(child);
        } else {
            spread(nodes, child, its_slots, rows);
        }
    };
    const SplitNode& node = nodes[row];
    place(node.left, node.left_slots[slots]);
    place(node.right, slots - node.left_slots[slots]);
}

WideNode empty_node() {
    constexpr float kEndless = std::numeric_limits<float>::infinity();
    WideNode node;
    for (std::size_t a = 0; a < 3; ++a) {
        std::fill_n(node.lower[a], kWidth, kEndless);
        std::fill_n(node.upper[a], kWidth, -kEndless);
    }
    std::fill_n(node.child, kWidth, WideNode::kAbsent);
    std::fill_n(node.order, kWidth, 0x76543210u);
    return node;
}

void set_box(WideNode& node, std::size_t slot, const FloatBox& box) {
    for (std::size_t a = 0; a < 3; ++a) node.lower[a][slot] = box.lower[a], node.upper[a][slot] = box.upper[a];
}

}  // namespace limn::accel
