// A 3D checkerboard of cubic cells.
#pragma once

#include <cmath>

#include "limn/math/vec.h"

namespace limn::pattern {

/// Returns true if floor(x) is odd. A double of magnitude 2^53 or more is an even integer. Infinities and NaN count as
/// even.
inline bool is_odd_cell(double x) {
    const double half = std::floor(x) / 2;
    return half - std::floor(half) == 0.5;
}

/// Returns true if floor(x/scale) + floor(y/scale) + floor(z/scale) is even.
inline bool checker_is_even(const Point3& p, double scale) {
    return (is_odd_cell(p.x / scale) ^ is_odd_cell(p.y / scale) ^ is_odd_cell(p.z / scale)) == 0;
}

}  // namespace limn::pattern
