/// \file
/// Axis-aligned bounding boxes.
#pragma once

#include <algorithm>

#include "limn/math/math.h"
#include "limn/math/vec.h"

namespace limn {

/// An axis-aligned box. It is a closed set: its faces belong to it. A box is empty if `lower` exceeds `upper` on an
/// axis; a default box is empty.
struct Box {
    /// The corner with the smallest coordinates and the corner with the largest ones. Coordinates may be infinite.
    ///@{
    Point3 lower{kInfinity, kInfinity, kInfinity};
    Point3 upper{-kInfinity, -kInfinity, -kInfinity};

    constexpr Box() = default;
    constexpr Box(const Point3& lo, const Point3& hi) : lower(lo), upper(hi) {}
    constexpr bool operator==(const Box&) const = default;
    ///@}

    /// Returns true if `lower` exceeds `upper` on an axis, or if a coordinate is NaN.
    constexpr bool is_empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
    /// Return true if the argument is inside the box; its faces count as inside. Every box contains an empty box.
    ///@{
    constexpr bool contains(const Point3& p) const {
        return p.x >= lower.x && p.x <= upper.x && p.y >= lower.y && p.y <= upper.y && p.z >= lower.z && p.z <= upper.z;
    }
    constexpr bool contains(const Box& b) const { return b.is_empty() || (contains(b.lower) && contains(b.upper)); }
    ///@}

    constexpr Vec3 diagonal() const { return upper - lower; }  ///< returns upper - lower
    /// Returns the centre. Coordinates are halved before they are added, so finite ones cannot overflow.
    constexpr Point3 center() const {
        return {lower.x / 2 + upper.x / 2, lower.y / 2 + upper.y / 2, lower.z / 2 + upper.z / 2};
    }
    /// Replace the box by the smallest box that contains it and the argument.
    ///@{
    constexpr void extend(const Point3& p) {
        for (std::size_t a = 0; a < 3; ++a) {
            lower[a] = std::min(lower[a], p[a]);
            upper[a] = std::max(upper[a], p[a]);
        }
    }
    constexpr void extend(const Box& b) {
        for (std::size_t a = 0; a < 3; ++a) {
            lower[a] = std::min(lower[a], b.lower[a]);
            upper[a] = std::max(upper[a], b.upper[a]);
        }
    }
    ///@}
};

/// Returns the smallest box that contains both boxes.
constexpr Box merge(Box a, const Box& b) {
    a.extend(b);
    return a;
}

/// Returns the sum of the areas of the six faces; 0 for an empty box.
constexpr double surface_area(const Box& b) {
    if (b.is_empty()) return 0;
    const Vec3 d = b.diagonal();
    return 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
}

/// Returns `b` with every face moved outward by `amount` and then to the next double. Rounding is outward, so the
/// result contains every point that is at most `amount` away from a point of `b` along each axis. An empty box is
/// returned as it is.
/// \pre amount >= 0
Box grow(const Box& b, const Vec3& amount);

}  // namespace limn
