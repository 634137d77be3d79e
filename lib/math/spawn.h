// Rays that start on surfaces. These functions are the bodies of the members of Surface (limn/math/surface.h), for
// callers that hold a FloatEnvironment already.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "limn/math/ray.h"
#include "limn/math/surface.h"

namespace limn {

// Returns the next double above x, or x if that is NaN or infinity. This is std::nextafter(x, infinity) without a call.
inline double next_up(double x) {
    if (!(x < kInfinity)) return x;
    if (x == 0) return std::numeric_limits<double>::denorm_min();
    const auto bits = std::bit_cast<std::uint64_t>(x);
    return std::bit_cast<double>(x > 0 ? bits + 1 : bits - 1);
}
// Returns the next double below x, or x if that is NaN or -infinity.
inline double next_down(double x) { return -next_up(-x); }

// Does the work of offset_origin() in limn/math/surface.h. The offset_along() for lanes in shading/stages.cpp gives the
// same bits.
inline Point3 offset_along(const Point3& position, const Vec3& error, const Normal3& normal, const Vec3& direction) {
    const double distance = dot(abs(Vec3(normal)), error);
    const Vec3 offset = (dot(normal, direction) < 0 ? -distance : distance) * Vec3(normal);
    // Rounding may move the sum back towards the surface. Therefore take the next double in the direction of the
    // offset.
    const auto add = [](double at, double by) {
        const double sum = at + by;
        return by > 0 ? next_up(sum) : by < 0 ? next_down(sum) : sum;
    };
    return {add(position.x, offset.x), add(position.y, offset.y), add(position.z, offset.z)};
}

// Shadow rays end at t = 1 - kShadowEnd. The gap is wider than the error of t that the filters usually allow for near t
// = 1, so they can tell without exact arithmetic that the light's own surface is not an obstacle. It is too narrow for
// any other shape.
inline constexpr double kShadowEnd = 0x1p-40;

// Does the work of Surface::spawn_ray().
inline Ray leave(const Surface& from, const Vec3& direction, double time) {
    return {offset_along(from.position, from.position_error, from.normal, direction), direction, 0, kInfinity, time};
}

// Does the work of Surface::spawn_ray_to() for a target on a surface.
inline Ray leave_for(const Surface& surface, const Surface& target, double time) {
    const Point3 from =
        offset_along(surface.position, surface.position_error, surface.normal, target.position - surface.position);
    const Point3 to = offset_along(target.position, target.position_error, target.normal, from - target.position);
    // The direction is rounded, so the ray hits the target's own surface near t = 1, not exactly there. t_max excludes
    // it.
    return {from, to - from, 0, 1 - kShadowEnd, time};
}

}  // namespace limn
