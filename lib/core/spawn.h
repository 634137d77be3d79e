// How rays leave surfaces: see Surface in core/surface.h, whose functions these are, for callers that hold a
// FloatEnvironment already.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "limn/core/ray.h"
#include "limn/core/surface.h"

namespace limn {

// std::nextafter towards +infinity, without a call.
inline double next_up(double x) {
    if (!(x < kInfinity)) return x;
    if (x == 0) return std::numeric_limits<double>::denorm_min();
    const auto bits = std::bit_cast<std::uint64_t>(x);
    return std::bit_cast<double>(x > 0 ? bits + 1 : bits - 1);
}
inline double next_down(double x) { return -next_up(-x); }

// Stands in lanes in shade/stages.cpp, with the same bits.
inline Point3 offset_along(const Point3& position, const Vec3& error, const Normal3& normal, const Vec3& direction) {
    const double distance = dot(abs(Vec3(normal)), error);
    const Vec3 offset = (dot(normal, direction) < 0 ? -distance : distance) * Vec3(normal);
    // The sum is rounded, perhaps back towards the surface.
    const auto add = [](double at, double by) {
        const double sum = at + by;
        return by > 0 ? next_up(sum) : by < 0 ? next_down(sum) : sum;
    };
    return {add(position.x, offset.x), add(position.y, offset.y), add(position.z, offset.z)};
}

// A share of the way that no shape fits into: the error of t that filters reckon with, with room.
inline constexpr double kShadowEnd = 0x1p-40;

inline Ray leave(const Surface& from, const Vec3& direction, double time) {
    return {offset_along(from.position, from.position_error, from.normal, direction), direction, 0, kInfinity, time};
}

inline Ray leave_for(const Surface& surface, const Surface& target, double time) {
    const Point3 from =
        offset_along(surface.position, surface.position_error, surface.normal, target.position - surface.position);
    const Point3 to = offset_along(target.position, target.position_error, target.normal, from - target.position);
    // The direction is rounded, and what lies at the end is told apart from obstacles by the filters' t.
    return {from, to - from, 0, 1 - kShadowEnd, time};
}

}  // namespace limn
