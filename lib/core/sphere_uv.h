// The sphere's centre in time, its normal and its coordinates, one definition for both worlds.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "limn/core/math.h"
#include "limn/core/ray.h"
#include "limn/core/vec.h"

namespace limn {

// Bit-exact at both ends.
inline Point3 interpolate(const Point3& at0, const Point3& at1, double time) {
    const double t = std::clamp(time, 0.0, 1.0);
    return {(1 - t) * at0.x + t * at1.x, (1 - t) * at0.y + t * at1.y, (1 - t) * at0.z + t * at1.z};
}

// Unit, outward for a positive radius. Taken from the hit point relative to the centre, where it does not cancel.
inline Vec3 sphere_normal(const Point3& center, const Ray& ray, double t) {
    const Vec3 way = (ray.origin - center) + t * ray.direction;
    const double squared = dot(way, way);
    if (squared > 1e-200 && squared < 1e200) return way / std::sqrt(squared);
    const Vec3 outward = normalize(way);
    // From so far away that rounding leaves nothing of the point, or beyond the squares of double: it faces the ray.
    return is_finite(outward) ? outward : -normalize(ray.direction);
}

// Shirley, Ray Tracing: The Next Week, section 4.4. The clamp: rounding may push a unit vector's y past 1.
inline Uv sphere_uv(const Vec3& n) {
    const double u = (arc_tangent(-n.z, n.x) + kPi) / (2 * kPi);
    return {std::clamp(u, 0.0, 1.0), arc_cosine(std::clamp(-n.y, -1.0, 1.0)) / kPi};
}

}  // namespace limn
