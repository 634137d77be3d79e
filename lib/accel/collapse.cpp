#include "accel/collapse.h"

#include <algorithm>

namespace limn::accel {

double half_area(const float* lower, const float* upper) {
    const double x = static_cast<double>(upper[0]) - lower[0], y = static_cast<double>(upper[1]) - lower[1],
                 z = static_cast<double>(upper[2]) - lower[2];
    // A little more, so that boxes without any area are told apart by their length.
    return x * y + y * z + z * x + 0x1p-20 * (x * x + y * y + z * z);
}

ForestCosts leaf_costs(double area, std::uint32_t count, const BuildSettings& settings) {
    ForestCosts costs;
    costs.fill(area * ((count + settings.leaf_width - 1) / settings.leaf_width) * settings.leaf_cost);
    return costs;
}

ForestCosts plan_node(double area, std::uint32_t count, const ForestCosts& left, const ForestCosts& right,
                      const BuildSettings& settings, Plan& plan) {
    std::array<double, kWidth + 1> spread;  // over i slots, two or more
    for (std::size_t slots = 2; slots <= kWidth; ++slots) {
        spread[slots] = left[0] + right[slots - 2];
        plan.left_slots[slots - 2] = 1;
        for (std::size_t k = 2; k < slots; ++k) {
            const double cost = left[k - 1] + right[slots - k - 1];
            if (cost < spread[slots]) spread[slots] = cost, plan.left_slots[slots - 2] = static_cast<std::uint8_t>(k);
        }
    }
    ForestCosts costs;
    costs[0] = spread[kWidth] + area * settings.node_cost;
    if (count <= settings.max_leaf) {
        const double leaf = leaf_costs(area, count, settings)[0];
        plan.is_leaf = leaf <= costs[0];
        costs[0] = std::min(costs[0], leaf);
    }
    plan.open_from = kWidth;
    for (std::size_t slots = kWidth - 1; slots >= 2; --slots) {
        const bool open = spread[slots] < costs[0] || (spread[slots] == costs[0] && !plan.is_leaf);
        if (open) plan.open_from = static_cast<std::uint8_t>(slots);
        costs[slots - 1] = open ? spread[slots] : costs[0];
    }
    return costs;
}

}  // namespace limn::accel
