// Ray against sphere, one definition for the described and the compiled world.
#pragma once

#include <cmath>

#include "limn/core/ray.h"
#include "limn/core/vec.h"

namespace limn {

struct SphereRoots {
    bool any = false;
    double near = 0, far = 0;  // near <= far
};

// The discriminant comes from the vector between the sphere's centre and the ray's point closest to it, so that it
// does not cancel for small distant spheres; the root that would cancel comes from the product of the roots. Haines,
// Guenther, Akenine-Moeller, Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems, ch. 7.
inline SphereRoots sphere_roots_in_range(const Vec3& from_center, double radius, const Vec3& direction) {
    const double a = dot(direction, direction);
    const double t_foot = -dot(from_center, direction) / a;
    const Vec3 foot = from_center + t_foot * direction;
    const double discriminant = radius * radius - dot(foot, foot);
    if (!(discriminant >= 0)) return {};
    const double half_chord = std::sqrt(discriminant / a);
    const double outer = t_foot + std::copysign(half_chord, t_foot);
    if (outer == 0) return {true, 0, 0};  // tangent at the origin
    const double inner = (dot(from_center, from_center) - radius * radius) / (a * outer);
    return outer < inner ? SphereRoots{true, outer, inner} : SphereRoots{true, inner, outer};
}

// The same where squares of the lengths would overflow or underflow.
SphereRoots sphere_roots_scaled(const Vec3& from_center, double radius, const Vec3& direction);

inline SphereRoots sphere_roots(const Point3& center, double radius, const Ray& ray) {
    const Vec3 from_center = ray.origin - center;
    const double a = dot(ray.direction, ray.direction), b = dot(from_center, from_center), c = radius * radius;
    if (a > 1e-140 && a < 1e140 && (b > 1e-140 || b == 0) && b < 1e140 && c > 1e-140 && c < 1e140)
        return sphere_roots_in_range(from_center, radius, ray.direction);
    return sphere_roots_scaled(from_center, radius, ray.direction);
}

// The nearest root in (t_min, t_max], or false.
inline bool intersect_sphere(const Point3& center, double radius, const Ray& ray, double t_max, double& t) {
    const SphereRoots roots = sphere_roots(center, radius, ray);
    if (!roots.any) return false;
    t = roots.near > ray.t_min ? roots.near : roots.far;
    return t > ray.t_min && t <= t_max && t < kInfinity;
}

}  // namespace limn
