// Bounds on how far a computed hit point may lie from its surface, times what lets the filter of the next intersection
// tell on which side a ray starts that is moved as far off the surface: the exact fallback would tell in any case,
// slower. The bounds are the same along every axis, for an intersection in a rotated or sheared frame mixes the axes.
#pragma once

#include <algorithm>
#include <cmath>

#include "limn/core/math.h"
#include "limn/core/transform.h"
#include "limn/core/vec.h"

namespace limn {

inline Vec3 along_every_axis(double bound) { return {bound, bound, bound}; }

// corner + u edge_u + v edge_v: five roundings of these magnitudes; the filter needs about 60 (is_behind).
inline Vec3 planar_error(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v) {
    return along_every_axis(gamma(64) * (max_abs(corner) + max_abs(edge_u) + max_abs(edge_v)));
}

// A point projected back onto the sphere.
inline Vec3 sphere_error(const Point3& center, double radius) {
    return along_every_axis(gamma(64) * (max_abs(center) + std::abs(radius)));
}

// origin + t direction, where nothing better is known.
inline Vec3 ray_error(const Ray& ray, double t) {
    return along_every_axis(gamma(16) * (max_abs(ray.origin) + std::abs(t) * max_abs(ray.direction)));
}

inline double norm(const Transform& m) {
    double sum = 0;
    for (const auto& row : m.rows) sum = std::max(sum, std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]));
    return sum;
}

// An object-space bound seen in world space, plus the rounding of the way out and of the next ray's way in
// (inverse_error), of which the filter needs six times.
inline Vec3 transformed_error(const Transform& world_from_object, const Transform& object_from_world,
                              const Point3& world_position, const Vec3& object_error) {
    const double magnitude = max_abs(world_position) + max_abs(world_from_object.translation());
    const double way_in = gamma(256) * norm(object_from_world) * magnitude;
    return along_every_axis(norm(world_from_object) * (max_abs(object_error) + way_in) + gamma(16) * magnitude);
}

}  // namespace limn
