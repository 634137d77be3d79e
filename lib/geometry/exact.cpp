#include "geometry/exact.h"

#include <cmath>

#include "geometry/dyadic.h"

namespace limn {

namespace {

// Returns the vector from the ray's origin to p, times ray.unit.
Dyadic3 from_origin(const Point3& p, const ExactRay& ray) { return ray.unit * to_dyadic(p) - ray.origin; }

// Returns (b - a) x (c - a).
Dyadic3 exact_cross(const Point3& a, const Point3& b, const Point3& c) {
    const Dyadic3 origin = to_dyadic(a);
    return cross(to_dyadic(b) - origin, to_dyadic(c) - origin);
}

}  // namespace

// Let A, B and C be the vertices relative to the ray's origin, D the direction and n the normal. The edge values are
//     wa = D.(B x C), wb = D.(C x A), wc = D.(A x B).
// Their sum is D.n. The ray hits if no two of them have opposite signs and the sum is not 0. Then t = n.A / n.D, where
// n.A = A.(B x C).
bool exact_triangle(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame, const Search& search,
                    PlanarHit& hit) {
    const ExactRay ray = exact_ray(frame);
    const Dyadic3 from_a = from_origin(a, ray), from_b = from_origin(b, ray), from_c = from_origin(c, ray);
    const Dyadic3 b_cross_c = cross(from_b, from_c);
    const Dyadic wa = dot(ray.direction, b_cross_c);
    const Dyadic wb = dot(ray.direction, cross(from_c, from_a));
    if (wa.sign() * wb.sign() < 0) return false;
    const Dyadic wc = dot(ray.direction, cross(from_a, from_b));
    if (wa.sign() * wc.sign() < 0 || wb.sign() * wc.sign() < 0) return false;
    const Dyadic sum = wa + wb + wc;
    if (sum.sign() == 0) return false;
    hit = {ratio(dot(from_a, b_cross_c), sum), ratio(wb, sum), ratio(wc, sum)};
    return search.contains(hit.t);
}

// Solves Q + u U + v V = t D, where Q is the corner relative to the ray's origin, U and V are the edges, and D is the
// direction. In the scalar product of both sides with V x D only u remains. With U x D only v remains, and with U x V
// only t.
bool exact_quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame,
                const Search& search, PlanarHit& hit) {
    const ExactRay ray = exact_ray(frame);
    const Dyadic3 q = from_origin(corner, ray);
    const Dyadic3 u = ray.unit * to_dyadic(edge_u), v = ray.unit * to_dyadic(edge_v);
    const Dyadic3 normal = cross(u, v);
    const Dyadic det = dot(ray.direction, normal);
    if (det.sign() == 0) return false;
    // True if w / det is in [0, 1].
    const auto is_weight = [&](const Dyadic& w) {
        return w.sign() * det.sign() >= 0 && (det - w).sign() * det.sign() >= 0;
    };
    const Dyadic wu = dot(q, cross(ray.direction, v)), wv = dot(q, cross(u, ray.direction));
    if (!is_weight(wu) || !is_weight(wv)) return false;
    hit = {ratio(dot(q, normal), det), ratio(wu, det), ratio(wv, det)};
    return search.contains(hit.t);
}

// Solves A t^2 + 2 B t + C = 0. With q = B + sign(B) sqrt(B^2 - A C), the root that does not cancel is -q / A
// (`outer`), and the other is -C / q (`inner`).
SphereHits exact_sphere(const Point3& center, double radius, const RayFrame& frame, const double* near,
                        const double* far, const Search& search) {
    // Compute the coefficients and the discriminant.
    const ExactRay ray = exact_ray(frame);
    const Dyadic3 p = ray.origin - ray.unit * to_dyadic(center);
    const Dyadic r = ray.unit * Dyadic(radius);
    const Dyadic a = dot(ray.direction, ray.direction), b = dot(p, ray.direction), c = dot(p, p) - r * r;
    const Dyadic discriminant = b * b - a * c;
    if (discriminant.sign() < 0) return {};

    // Compute both roots, except for those that the caller has.
    const Dyadic root = discriminant.square_root();
    const Dyadic q = b.sign() < 0 ? b - root : b + root;
    const double outer = ratio(-q, a);
    const double inner = discriminant.sign() == 0 ? outer : ratio(-c, q);
    SphereHits hits;
    hits.near = near != nullptr ? *near : b.sign() < 0 ? inner : outer;
    hits.far = far != nullptr ? *far : b.sign() < 0 ? outer : inner;
    // Rounding may reverse the order of the roots: make them equal then. Keep a root that the filter has found, because
    // the filter reports it too if it can decide.
    if (near != nullptr)
        hits.far = larger(hits.far, hits.near);
    else
        hits.near = smaller(hits.near, hits.far);
    hits.near_found = search.contains(hits.near);
    hits.far_found = search.contains(hits.far);
    return hits;
}

bool are_parallel(const Vec3& u, const Vec3& v) { return are_collinear(Point3{}, Point3{} + u, Point3{} + v); }

bool are_collinear(const Point3& a, const Point3& b, const Point3& c) {
    // Each coordinate of the cross product is off by at most 8 kRoundoff |u| |v|, where |u| and |v| are the largest
    // coordinates: 4 from the roundings of u and v, 4 from its own.
    const Vec3 u = b - a, v = c - a;
    const double largest = max_abs(cross(u, v)), bound = 16 * kRoundoff * max_abs(u) * max_abs(v) + 0x1p-1000;
    if (largest > bound && largest < kInfinity) return false;
    const Dyadic3 exact = exact_cross(a, b, c);
    return exact.x.sign() == 0 && exact.y.sign() == 0 && exact.z.sign() == 0;
}

Normal3 exact_normal(const Point3& a, const Point3& b, const Point3& c) {
    const Dyadic3 n = exact_cross(a, b, c);
    const Dyadic length = dot(n, n).square_root();
    return {ratio(n.x, length), ratio(n.y, length), ratio(n.z, length)};
}

}  // namespace limn
