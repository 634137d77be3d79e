// Ray against sphere, triangle, parallelogram and box in exact arithmetic on the stored doubles. Every decision is the
// sign of a polynomial in them, worked out in integers times powers of two: nothing is rounded, so nothing is
// undecided. t, u and v are quotients and roots of such polynomials, rounded in __float128 (relative error < 1e-32).
#pragma once

#include <span>

#include "limn/math/ray.h"
#include "limn/math/transform.h"
#include "support/real.h"

namespace limn::test {

/// The nearest hit with t in (t_min, t_max]. An unusable ray misses.
struct ExactHit {
    bool hit = false;
    Real t = 0, u = 0, v = 0;
};

/// `chain`: the matrices (world from object, invertible) that the shape is seen through, outermost first. The truth is
/// the exact image of the shape. t is in units of the ray's direction.
///@{
ExactHit exact_sphere_hit(const Point3& center, double radius, const Ray& ray, std::span<const Transform> chain = {});
ExactHit exact_triangle_hit(const Point3& a, const Point3& b, const Point3& c, const Ray& ray,
                            std::span<const Transform> chain = {});
ExactHit exact_quad_hit(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const Ray& ray,
                        std::span<const Transform> chain = {});
///@}

/// Whether the closed box has a point of the ray with t in [t_min, t_max]. Its sides may be infinite.
bool exact_box_hit(const Box& box, const Ray& ray);

/// Whether the area is exactly zero.
bool exactly_flat(const Point3& a, const Point3& b, const Point3& c);

/// Whether a ray passes through a triangle after its origin: 1 along the normal, -1 against it, 0 not at all. It starts
/// at the origin moved by (e, e^2, e^3) with e > 0 less than any number.
int exact_moved_passage(const Point3& a, const Point3& b, const Point3& c, const Point3& origin, const Vec3& direction);

/// Whether a point lies on the closed triangle, whose area is not zero.
bool exactly_on_triangle(const Point3& a, const Point3& b, const Point3& c, const Point3& p);

}  // namespace limn::test
