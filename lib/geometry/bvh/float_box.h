// Converts boxes of doubles to the boxes of floats that trees are built from.
#pragma once

#include <cmath>
#include <limits>

#include "geometry/bvh/wide_bvh.h"
#include "limn/math/box.h"

namespace limn::accel {

// Returns a float that is at most x, and isn't subnormal. Each subnormal number would delay a box test by some hundred
// cycles.
inline float round_down(double x) {
    constexpr float kLeast = std::numeric_limits<float>::min();
    const auto f = static_cast<float>(x);
    const float below = f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
    return std::abs(below) >= kLeast ? below : below < 0 ? -kLeast : 0;
}

inline float round_up(double x) { return -round_down(-x); }

// Returns the box with all coordinates multiplied by `scale`, rounded outward. \pre `scale` is a positive power of two
inline FloatBox to_float_box(const Box& box, double scale = 1) {
    FloatBox f;
    for (std::size_t a = 0; a < 3; ++a) {
        f.lower[a] = round_down(scale * box.lower[a]);
        f.upper[a] = round_up(scale * box.upper[a]);
    }
    return f;
}

// Returns a power of two by which coordinates up to `extent` are multiplied to be at most 1. Without this scale, a box
// beyond the range of float would count as unbounded.
inline double scale_to_one(double extent) {
    int exponent = 0;
    std::frexp(extent, &exponent);
    return std::ldexp(1.0, -std::max(exponent, -1000));  // the limit keeps the result finite
}

}  // namespace limn::accel
