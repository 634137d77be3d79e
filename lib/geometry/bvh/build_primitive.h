// The items that the builder sorts: boxes with the indices of their primitives, in two vectors of four floats.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "geometry/bvh/wide_bvh.h"

namespace limn::accel {

// The vector types of g++ and clang. They compile to the baseline instructions of any x86-64 or ARM processor.
using Vec4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Vec4 splat(float x) { return Vec4{x, x, x, x}; }
inline Vec4 min(Vec4 a, Vec4 b) { return a < b ? a : b; }
inline Vec4 max(Vec4 a, Vec4 b) { return a > b ? a : b; }

// A box. The fourth lanes of `lower` and `upper` aren't used.
struct Bounds {
    Vec4 lower, upper;

    void extend(const Bounds& b) {
        lower = min(lower, b.lower);
        upper = max(upper, b.upper);
    }
};

inline constexpr Vec4 kEndless{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
                               std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()};
inline constexpr Bounds kEmpty{kEndless, -kEndless};

// A box with the index of its primitive, or a cell of a grid. The bounds of a cell are those of the boxes whose centres
// are in it. The fourth lane of `lower` holds the index. The fourth lane of `upper` holds the number of boxes, the
// weight. Arithmetic is done on all lanes, and it is slow if a lane is a subnormal float. Small integers have the bits
// of subnormal floats, so the index is stored with the bit kNormal flipped.
struct BuildPrimitive : Bounds {
    static constexpr std::uint32_t kNormal = 0x40000000u;

    BuildPrimitive() = default;
    BuildPrimitive(const Bounds& b, std::uint32_t index, std::uint32_t weight = 1) : Bounds(b) {
        lower[3] = std::bit_cast<float>(index ^ kNormal);
        upper[3] = std::bit_cast<float>(weight);
    }

    std::uint32_t index() const { return std::bit_cast<std::uint32_t>(lower[3]) ^ kNormal; }
    std::uint32_t weight() const { return std::bit_cast<std::uint32_t>(upper[3]); }
    Vec4 center() const { return lower + upper; }  // twice the centre; can't overflow for bounded boxes
};
static_assert(sizeof(BuildPrimitive) == 32);

// Consecutive build primitives, with their bounds and the bounds of their centres.
struct Range {
    std::uint32_t begin = 0, end = 0;
    Bounds bounds = kEmpty, centers = kEmpty;  // `centers` bounds BuildPrimitive::center, twice the centres

    std::uint32_t size() const { return end - begin; }
    void extend(const BuildPrimitive& p) {
        bounds.extend(p);
        centers.extend({p.center(), p.center()});
    }
    void extend(const Range& r) {
        bounds.extend(r.bounds);
        centers.extend(r.centers);
    }
};

inline Bounds to_bounds(const FloatBox& b) {
    return {Vec4{b.lower[0], b.lower[1], b.lower[2]}, Vec4{b.upper[0], b.upper[1], b.upper[2]}};
}

// Returns the range of primitives [begin, end) with its bounds.
inline Range range_over(const BuildPrimitive* primitives, std::uint32_t begin, std::uint32_t end) {
    Range range{begin, end};
    for (std::uint32_t i = begin; i < end; ++i) range.extend(primitives[i]);
    return range;
}

}  // namespace limn::accel
