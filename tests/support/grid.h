// Numbers for properties: multiples of 1/64 up to 16. Sums, differences and products of two of them are exact in
// double, so that a law which holds in exact arithmetic can be asked for to the bit.
#pragma once

#include <rapidcheck.h>

#include <cmath>
#include <cstdint>

#include "limn/math/vec.h"

namespace limn::test {

/// A whole number from first to last; shrinks to the first. To be called inside holds(), as all that follow.
inline int draw_int(int first, int last) {
    return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(first, last + 1));  // of full range from the first try
}

/// A multiple of 1/64 up to limit / 64 either way; shrinks to 0.
inline double draw_on_grid(int limit = 1024) {
    const int n = draw_int(0, 2 * limit);
    return (n % 2 ? -(n + 1) / 2 : n / 2) / 64.0;
}

inline Vec3 draw_vec(int limit = 1024) {
    const double x = draw_on_grid(limit), y = draw_on_grid(limit);
    return {x, y, draw_on_grid(limit)};
}
inline Point3 draw_point(int limit = 1024) { return Point3{} + draw_vec(limit); }

/// 2^k, k from first to last.
inline double draw_power_of_two(int first, int last) { return std::ldexp(1.0, draw_int(first, last)); }

/// A number in [0, 1), all 53 bits of it.
inline double draw_unit() {
    const auto bits = *rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint64_t>());
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

}  // namespace limn::test
