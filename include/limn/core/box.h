/// \file
/// Axis-aligned bounding boxes: closed sets; `lower > upper` on any axis means empty.
#pragma once

#include <algorithm>

#include "limn/core/math.h"
#include "limn/core/vec.h"

namespace limn {

/// A closed box: both corners belong to it. Empty until it is extended.
struct Box {
    /// The corners with the smallest and with the largest coordinates; either may be infinite.
    ///@{
    Point3 lower{kInfinity, kInfinity, kInfinity};
    Point3 upper{-kInfinity, -kInfinity, -kInfinity};

    constexpr Box() = default;
    constexpr Box(const Point3& lo, const Point3& hi) : lower(lo), upper(hi) {}
    constexpr bool operator==(const Box&) const = default;
    ///@}

    /// Also where a coordinate is NaN.
    constexpr bool is_empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
    /// The border counts; an empty box is in every box.
    ///@{
    constexpr bool contains(const Point3& p) const {
        return p.x >= lower.x && p.x <= upper.x && p.y >= lower.y && p.y <= upper.y && p.z >= lower.z && p.z <= upper.z;
    }
    constexpr bool contains(const Box& b) const { return b.is_empty() || (contains(b.lower) && contains(b.upper)); }
    ///@}

    constexpr Vec3 diagonal() const { return upper - lower; }  ///< from lower to upper
    /// Halved before it is summed, so that it cannot overflow.
    constexpr Point3 center() const {
        return {lower.x / 2 + upper.x / 2, lower.y / 2 + upper.y / 2, lower.z / 2 + upper.z / 2};
    }
    /// Makes the box the smallest one that contains it and the argument.
    ///@{
    constexpr void extend(const Point3& p) {
        for (std::size_t a = 0; a < 3; ++a) lower[a] = std::min(lower[a], p[a]), upper[a] = std::max(upper[a], p[a]);
    }
    constexpr void extend(const Box& b) {
        for (std::size_t a = 0; a < 3; ++a)
            lower[a] = std::min(lower[a], b.lower[a]), upper[a] = std::max(upper[a], b.upper[a]);
    }
    ///@}
};

/// The smallest box around both.
constexpr Box merge(Box a, const Box& b) {
    a.extend(b);
    return a;
}

/// Of all six faces; 0 for an empty box.
constexpr double surface_area(const Box& b) {
    if (b.is_empty()) return 0;
    const Vec3 d = b.diagonal();
    return 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
}

/// `b` with every face moved outward by `amount` and then to the next double, so that it contains all that
/// `amount` bounds. \pre amount >= 0
Box grow(const Box& b, const Vec3& amount);

}  // namespace limn
