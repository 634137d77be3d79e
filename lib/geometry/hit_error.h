// Bounds on the distance of a computed hit point from its surface.
//
// The next ray starts at a point that is moved off the surface by this bound. The bounds are larger than the error
// itself, so that the filter of the next intersection can decide on which side of the surface the ray starts. With the
// error alone, the exact fallback would have to decide, which is slower.
//
// A bound is the same along every axis, because an intersection in a rotated or sheared frame mixes the axes.
#pragma once

#include <algorithm>
#include <cmath>

#include "limn/math/math.h"
#include "limn/math/ray.h"
#include "limn/math/transform.h"
#include "limn/math/vec.h"

namespace limn {

inline Vec3 along_every_axis(double bound) { return {bound, bound, bound}; }

// Returns the bound for the point corner + u edge_u + v edge_v. The point is off by five roundings of these magnitudes;
// the filter needs about 60 (is_behind() in planar-inl.h).
inline Vec3 planar_error(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v) {
    return along_every_axis(gamma(64) * (max_abs(corner) + max_abs(edge_u) + max_abs(edge_v)));
}

// Returns the bound for a point that was projected back onto the sphere.
inline Vec3 sphere_error(const Point3& center, double radius) {
    return along_every_axis(gamma(64) * (max_abs(center) + std::abs(radius)));
}

// Returns the bound for the point origin + t direction, for shapes without a better bound.
inline Vec3 ray_error(const Ray& ray, double t) {
    return along_every_axis(gamma(16) * (max_abs(ray.origin) + std::abs(t) * max_abs(ray.direction)));
}

// Returns the largest sum of magnitudes in a row of the linear part.
inline double norm(const Transform& m) {
    double sum = 0;
    for (const auto& row : m.rows) sum = std::max(sum, std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]));
    return sum;
}

// Returns a bound in world space for a hit point with the bound `object_error` in object space. It is the transformed
// bound, plus the rounding of the transformation to world space, plus six times the rounding of the next ray's
// transformation into object space (inverse_error()), which the filter needs.
inline Vec3 transformed_error(const Transform& world_from_object, const Transform& object_from_world,
                              const Point3& world_position, const Vec3& object_error) {
    const double magnitude = max_abs(world_position) + max_abs(world_from_object.translation());
    const double way_in = gamma(256) * norm(object_from_world) * magnitude;
    return along_every_axis(norm(world_from_object) * (max_abs(object_error) + way_in) + gamma(16) * magnitude);
}

}  // namespace limn
