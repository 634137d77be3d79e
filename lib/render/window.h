// Sums over the pixels around each pixel of a row.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace limn::transport {

// Calls use(x, sum, count) for each pixel (x, y) of row y, from left to right. The window of a pixel is the square of
// 2 reach + 1 pixels a side around it, clipped to the picture. `sum` is the sum of value_at(i, j) over the window, and
// `count` is its number of pixels. The order of the additions is fixed: column by column.
template <class ValueAt, class Use>
void for_each_window(int width, int height, int y, int reach, const ValueAt& value_at, const Use& use) {
    using Value = decltype(value_at(0, 0));
    const int top = std::max(0, y - reach), bottom = std::min(height - 1, y + reach);
    std::vector<Value> columns(static_cast<std::size_t>(width));
    for (int j = top; j <= bottom; ++j)
        for (int i = 0; i < width; ++i) columns[static_cast<std::size_t>(i)] += value_at(i, j);
    for (int x = 0; x < width; ++x) {
        const int left = std::max(0, x - reach), right = std::min(width - 1, x + reach);
        Value sum{};
        for (int i = left; i <= right; ++i) sum += columns[static_cast<std::size_t>(i)];
        use(x, sum, (right - left + 1) * (bottom - top + 1));
    }
}

}  // namespace limn::transport
