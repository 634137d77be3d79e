// What the builder moves about: a box with its number, in two vectors of four floats.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "accel/wide_bvh.h"

namespace limn::accel {

// Vectors as g++ and clang have them: the builder needs no more than any x86-64 or ARM processor offers.
using Vec4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Vec4 splat(float x) { return Vec4{x, x, x, x}; }
inline Vec4 min(Vec4 a, Vec4 b) { return a < b ? a : b; }
inline Vec4 max(Vec4 a, Vec4 b) { return a > b ? a : b; }

struct alignas(32) Reference {
    Vec4 lower, upper;  // the fourth lane of `lower` holds the number

    std::uint32_t id() const { return std::bit_cast<std::uint32_t>(lower[3]); }
};
static_assert(sizeof(Reference) == 32);

// The fourth lane holds nothing of meaning.
struct Bounds {
    Vec4 lower = splat(std::numeric_limits<float>::infinity());
    Vec4 upper = splat(-std::numeric_limits<float>::infinity());

    void extend(const Bounds& b) {
        lower = min(lower, b.lower);
        upper = max(upper, b.upper);
    }
};

inline Bounds bounds_of(const Reference& r) { return {r.lower, r.upper}; }

// Twice the centre. Bounded boxes are small enough for the sum.
inline Vec4 center_of(const Bounds& b) { return b.lower + b.upper; }

}  // namespace limn::accel
