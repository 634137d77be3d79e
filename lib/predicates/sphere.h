// Ray against sphere, one definition for the described and the compiled world.
#pragma once

#include <cmath>

#include "limn/core/vec.h"
#include "predicates/exact.h"

namespace limn {

// What all spheres need of a ray.
struct SphereRay {
    Point3 origin;
    Vec3 direction;
    double squared;             // length of the direction
    double inverse_length;      // at least 1 / length
    double relative, absolute;  // bound on the distance of the foot point from the exact one: relative L + absolute
    const RayFrame* frame;      // kept by reference

    explicit SphereRay(const RayFrame& f)
        : origin(f.ray.origin),
          direction(f.ray.direction),
          squared(dot(direction, direction)),
          inverse_length(1 / largest_magnitude(direction.x, direction.y, direction.z)),
          relative((10 * kRoundoff + 8 * f.direction_error * inverse_length) * (1 + 0x1p-30)),
          absolute(2 * f.origin_error * (1 + 0x1p-30)),
          frame(&f) {}
    bool is_in_range() const { return squared > 0x1p-460 && squared < 0x1p460; }
};

// Both roots, or that there are none, or unsure.
struct SphereRoots {
    Decision decision = Decision::miss;
    Approximate near{}, far{};
};

// The filter. The discriminant comes from the foot point F, the ray's point closest to the centre, so that it does not
// cancel for small distant spheres; the root that would cancel comes from the product of the roots. Haines, Guenther,
// Akenine-Moeller, Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems, ch. 7.
//
// With p = o - c, L >= |p|, u = 2^-53: p is off by u L + e, e from the origin; p.d / d.d times d by 8 u L; the sum by u
// L: F in all by E = 10 u L + e, and a direction off by an angle s adds 8 s L generously. So r^2 - F.F is off by at
// most E (2 |F| + E) + 6 u (r^2 + F.F), and r^2 - F.F of the right sign if it exceeds E (4 r + E) + 32 u (r^2 + F.F):
// |F| <= 2 r is clear; beyond, a wrong sign needs E >= |F| - r, and then E (4 r + E) > F.F - r^2.
//
// The half chord h has half the relative error of the discriminant, at most D / disc, and 4 u; t at the foot point is
// off by E / |d|. p.p - r^2 is off by 8 u (L^2 + r^2) + 2 e (2 L + e).
inline SphereRoots filter_sphere(const Point3& center, double radius, const SphereRay& ray) {
    const Vec3 p = ray.origin - center;
    const double reach = std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
    if (!(ray.is_in_range() && reach < 0x1p230 && radius < 0x1p230 && radius > 0x1p-230)) return {Decision::undecided};

    const double foot_t = -dot(p, ray.direction) / ray.squared;
    const Vec3 foot = p + foot_t * ray.direction;
    const double r2 = radius * radius, foot2 = dot(foot, foot);
    const double discriminant = r2 - foot2;
    const double foot_error = ray.relative * reach + ray.absolute;
    const double error = foot_error * (4 * radius + foot_error) + 32 * kRoundoff * (r2 + foot2);
    if (discriminant < -error) return {};
    if (!(discriminant > error)) return {Decision::undecided};

    const double half_chord = std::sqrt(discriminant / ray.squared);
    const double outer = foot_t + std::copysign(half_chord, foot_t);
    const double outer_error = foot_error * ray.inverse_length + half_chord * (error / discriminant + ray.relative) +
                               4 * kRoundoff * std::abs(outer);
    if (outer_error > 0.25 * std::abs(outer)) return {Decision::undecided};
    const double power = dot(p, p) - r2;
    const double power_error = 8 * kRoundoff * (reach * reach + r2) + ray.absolute * (2 * reach + ray.absolute);
    const double inner = power / (ray.squared * outer);
    const double inner_error = power_error / (ray.squared * std::abs(outer)) * 2 +
                               std::abs(inner) * (2 * (outer_error / std::abs(outer)) + 2 * ray.relative);
    const Approximate first{outer, outer_error}, second{inner, inner_error};
    return outer < inner ? SphereRoots{Decision::hit, first, second} : SphereRoots{Decision::hit, second, first};
}

// Exact: which roots lie within the search. If not `both`, only the first of them counts.
inline SphereHits intersect_sphere(const Point3& center, double radius, const SphereRay& ray, const Search& search,
                                   bool both) {
    const SphereRoots roots = filter_sphere(center, radius, ray);
    if (roots.decision == Decision::miss) return {};
    if (roots.decision == Decision::undecided)
        return exact_sphere(center, radius, *ray.frame, nullptr, nullptr, search);
    const Decision near = in_search(roots.near, search);
    if (near == Decision::hit && !both) return {true, false, roots.near.value, 0};
    const Decision far = in_search(roots.far, search);
    if (near == Decision::undecided || far == Decision::undecided)
        return exact_sphere(center, radius, *ray.frame, &roots.near, &roots.far, search);
    return {near == Decision::hit, far == Decision::hit, roots.near.value, roots.far.value};
}

// The first t within the search, or false.
inline bool intersect_sphere(const Point3& center, double radius, const SphereRay& ray, const Search& search,
                             double& t) {
    const SphereHits hits = intersect_sphere(center, radius, ray, search, false);
    t = hits.near_found ? hits.near : hits.far;
    return hits.near_found || hits.far_found;
}

}  // namespace limn
