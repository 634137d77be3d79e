// The linear part of a matrix brought near 1, so that products of its entries neither underflow nor overflow.
#pragma once

#include <algorithm>
#include <cmath>

#include "limn/core/transform.h"

namespace limn {

// std::ldexp(x, exponent) by a multiplication, which rounds alike, wherever that power of two is a double.
class PowerOfTwo {
public:
    explicit PowerOfTwo(int exponent) : exponent_(exponent), factor_(std::ldexp(1.0, exponent)) {}
    double operator*(double x) const { return std::isfinite(factor_) ? x * factor_ : std::ldexp(x, exponent_); }

private:
    int exponent_;
    double factor_;
};

// m = matrix * 2^exponent, exactly but for entries that are too small beside the largest; translation left as it is.
struct ScaledMatrix {
    Transform matrix;
    int exponent = 0;

    explicit ScaledMatrix(const Transform& m) : matrix(m) {
        double largest = 0;
        for (const auto& row : m.rows)
            for (std::size_t j = 0; j < 3; ++j) largest = std::max(largest, std::abs(row[j]));
        std::frexp(largest, &exponent);
        const PowerOfTwo scale(-exponent);
        for (auto& row : matrix.rows)
            for (std::size_t j = 0; j < 3; ++j) row[j] = scale * row[j];
    }
};

}  // namespace limn
