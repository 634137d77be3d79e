#include "geometry/exact_disk.h"

#include <cmath>

#include "geometry/bounds.h"
#include "geometry/disk-inl.h"
#include "geometry/dyadic.h"
#include "limn/math/frame.h"
#include "limn/math/math.h"

HWY_BEFORE_NAMESPACE();
namespace limn {

bool intersect_disk(const Point3& center, const Vec3& normal, double radius, const RayFrame& frame,
                    const Search& search, PlanarHit& hit) {
    const auto disk = HWY_NAMESPACE::disk_of<double>(center, normal, radius);
    if (!HWY_NAMESPACE::intersect(disk, frame, search, hit)) return false;
    // Compute u and v from the point where the ray crosses the plane, if that is accurate enough.
    const auto c = disk.crossing(HWY_NAMESPACE::ray_of<double>(frame));
    const double reach = c.b * radius;
    if (c.known && 2 * c.w_error + radius * c.b_error <= kAccurateWeight * std::abs(reach)) {
        const Frame axes(normalize(normal));
        const Vec3 w{c.w.x, c.w.y, c.w.z};
        hit.u = 0.5 + 0.5 * dot(w, axes.x) / reach;
        hit.v = 0.5 + 0.5 * dot(w, axes.y) / reach;
        return true;
    }
    // Otherwise compute them exactly. t remains that of the filter.
    PlanarHit exact;
    exact_disk(center, normal, radius, frame, search, exact);
    hit.u = exact.u;
    hit.v = exact.v;
    return true;
}

// Uses the formulas of DiskPredicate::crossing() with q = c - o instead of p: b = d.n, a = q.n and w = a d - b q. Then
// t = a / b.
bool exact_disk(const Point3& center, const Vec3& normal, double radius, const RayFrame& frame, const Search& search,
                PlanarHit& hit) {
    const ExactRay ray = exact_ray(frame);
    const Dyadic3 n = to_dyadic(normal), q = ray.unit * to_dyadic(center) - ray.origin;
    const Dyadic a = dot(q, n), b = dot(ray.direction, n);
    if (b.sign() == 0) return false;
    const Dyadic3 w = a * ray.direction - b * q;
    const Dyadic reach = b * (ray.unit * Dyadic(radius));
    if (reach * reach < dot(w, w)) return false;
    const Frame axes(normalize(normal));
    const auto along = [&](const Vec3& axis) { return ratio(reach + dot(w, to_dyadic(axis)), reach + reach); };
    hit = {ratio(a, b), along(axes.x), along(axes.y)};
    return search.contains(hit.t);
}

// With a unit normal n, a disk extends along axis a by r sqrt(1 - n_a^2) to both sides. For a normal of any length this
// is r sqrt(n_b^2 + n_c^2) / |n|, where b and c are the other two axes.
Box disk_bounds(const Point3& center, const Vec3& normal, double radius) {
    const Vec3 n = normal / max_abs(normal);
    const double whole = length(n);
    Box box;
    for (std::size_t a = 0; a < 3; ++a) {
        // gamma(16) covers the rounding of `reach`.
        const double b = n[(a + 1) % 3], c = n[(a + 2) % 3];
        const double reach = radius * (std::sqrt(b * b + c * c) / whole) * (1 + gamma(16));
        box.lower[a] = difference_down(center[a], reach);
        box.upper[a] = difference_up(center[a], -reach);
    }
    return box;
}

}  // namespace limn
HWY_AFTER_NAMESPACE();
