// The centre of a moving sphere, its normal and its texture coordinates. The described and the compiled sphere share
// these definitions.
#pragma once

#include <algorithm>
#include <cmath>

#include "limn/math/math.h"
#include "limn/math/ray.h"
#include "limn/math/vec.h"
#include "math/elementary.h"

namespace limn {

// Returns the point that moves on a straight line from at0 at time 0 to at1 at time 1. `time` is clamped to [0, 1]. At
// both ends the result has the same bits as at0 and at1.
inline Point3 interpolate(const Point3& at0, const Point3& at1, double time) {
    const double t = std::clamp(time, 0.0, 1.0);
    return {(1 - t) * at0.x + t * at1.x, (1 - t) * at0.y + t * at1.y, (1 - t) * at0.z + t * at1.z};
}

// Returns the unit vector from the centre to the hit point at t: the outward normal of a sphere with a positive radius.
// The hit point is computed relative to the centre. Subtracting the centre from the hit point in world space would
// cancel for small spheres.
inline Vec3 sphere_normal(const Point3& center, const Ray& ray, double t) {
    const Vec3 way = (ray.origin - center) + t * ray.direction;
    const double squared = dot(way, way);
    if (squared > 1e-200 && squared < 1e200) return way / std::sqrt(squared);
    const Vec3 outward = normalize(way);
    // There is no direction if rounding cancels `way` to zero, for a ray from far away, or if `way` overflows. Then
    // return the normal that faces the ray.
    return is_finite(outward) ? outward : -normalize(ray.direction);
}

// Returns the texture coordinates of a point of the unit sphere (Shirley, Ray Tracing: The Next Week, section 4.4). The
// clamps are needed because rounding may push a coordinate past its range.
inline Uv sphere_uv(const Vec3& n) {
    const double u = (arc_tangent(-n.z, n.x) + kPi) / (2 * kPi);
    return {std::clamp(u, 0.0, 1.0), arc_cosine(std::clamp(-n.y, -1.0, 1.0)) / kPi};
}

}  // namespace limn
