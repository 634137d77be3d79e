#include "scene/shape/position_numbers.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace limn {

std::vector<std::uint32_t> position_numbers(const std::vector<Float3>& vertices) {
    std::vector<std::uint32_t> order(vertices.size()), numbers(vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&vertices](std::uint32_t i) {
        return std::tie(vertices[i].x, vertices[i].y, vertices[i].z);  // compares -0 and 0 as equal
    };
    std::sort(order.begin(), order.end(), [&key](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && key(order[i - 1]) != key(order[i])) ++number;
        numbers[order[i]] = number;
    }
    return numbers;
}

}  // namespace limn
