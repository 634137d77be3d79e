// Parity of the cubic cells of space.
#pragma once

#include <cmath>

#include "limn/core/vec.h"

namespace limn::pattern {

/// Whether floor(x) is odd. Doubles from 2^53 on are even integers; infinities and NaN count as even.
inline bool is_odd_cell(double x) {
    const double half = std::floor(x) / 2;
    return half - std::floor(half) == 0.5;
}

/// Whether floor(x/scale) + floor(y/scale) + floor(z/scale) is even.
inline bool checker_is_even(const Point3& p, double scale) {
    return (is_odd_cell(p.x / scale) ^ is_odd_cell(p.y / scale) ^ is_odd_cell(p.z / scale)) == 0;
}

}  // namespace limn::pattern
