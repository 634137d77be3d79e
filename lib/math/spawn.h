// These functions make rays that leave surfaces. Their caller holds a FloatEnvironment.
#pragma once

#include "limn/math/ray.h"
#include "limn/math/surface.h"

namespace limn {

// Does the work of offset_origin() in limn/math/surface.h.
Point3 offset_along(const Point3& position, const Vec3& error, const Normal3& normal, const Vec3& direction);

// Shadow rays end at t = 1 - kShadowEnd. The gap is wider than the error of t that the filters usually allow for near t
// = 1, so they can tell without exact arithmetic that the light's own surface is not an obstacle. It is too narrow for
// any other shape.
inline constexpr double kShadowEnd = 0x1p-40;

// Does the work of Surface::spawn_ray().
inline Ray leave(const Surface& from, const Vec3& direction, double time) {
    return {offset_along(from.position, from.position_error, from.normal, direction), direction, 0, kInfinity, time};
}

}  // namespace limn
