// A matrix whose linear part is scaled to magnitudes near 1, so that products of its entries don't overflow or
// underflow.
#pragma once

#include <algorithm>
#include <cmath>

#include "limn/math/transform.h"

namespace limn {

// A factor 2^exponent. If it is a double, the product is one multiplication, else std::ldexp(x, exponent). Both round
// alike.
class PowerOfTwo {
public:
    explicit PowerOfTwo(int exponent) : exponent_(exponent), factor_(std::ldexp(1.0, exponent)) {}
    double operator*(double x) const { return std::isfinite(factor_) ? x * factor_ : std::ldexp(x, exponent_); }

private:
    int exponent_;
    double factor_;
};

// The linear part of a Transform m, scaled by a power of two: its largest entry is in [1/2, 1), and m = matrix *
// 2^exponent. This is exact except for entries that underflow because they are so much smaller than the largest. The
// translation of `matrix` is that of m.
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
