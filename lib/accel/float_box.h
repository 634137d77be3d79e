// From boxes in double to those that trees are built of.
#pragma once

#include <cmath>
#include <limits>

#include "accel/wide_bvh.h"
#include "limn/core/box.h"

namespace limn::accel {

inline float round_down(double x) {
    const auto f = static_cast<float>(x);
    return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}

inline float round_up(double x) {
    const auto f = static_cast<float>(x);
    return f < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

// The box `scale` times as large, rounded outward; \pre `scale` is a positive power of two.
inline FloatBox to_float_box(const Box& box, double scale = 1) {
    FloatBox f;
    for (std::size_t a = 0; a < 3; ++a)
        f.lower[a] = round_down(scale * box.lower[a]), f.upper[a] = round_up(scale * box.upper[a]);
    return f;
}

// The power of two that brings coordinates up to `extent` to one at most, so that no box beyond the range of float
// counts as unbounded.
inline double scale_to_one(double extent) {
    int exponent = 0;
    std::frexp(extent, &exponent);
    return std::ldexp(1.0, -std::max(exponent, -1000));  // finite
}

}  // namespace limn::accel
