// The linear part of a matrix brought near 1, so that products of its entries neither underflow nor overflow.
#pragma once

#include <algorithm>
#include <cmath>

#include "limn/core/transform.h"

namespace limn {

// m = matrix * 2^exponent, exactly but for entries that are too small beside the largest; translation left as it is.
struct ScaledMatrix {
    Transform matrix;
    int exponent = 0;

    explicit ScaledMatrix(const Transform& m) : matrix(m) {
        double largest = 0;
        for (const auto& row : m.rows)
            for (std::size_t j = 0; j < 3; ++j) largest = std::max(largest, std::abs(row[j]));
        std::frexp(largest, &exponent);
        for (auto& row : matrix.rows)
            for (std::size_t j = 0; j < 3; ++j) row[j] = std::ldexp(row[j], -exponent);
    }
};

}  // namespace limn
