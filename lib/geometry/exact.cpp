#include "geometry/exact.h"

#include <cmath>

#include "geometry/fixed.h"

namespace limn {

namespace {

// Returns the vector from the ray's origin to p, times ray.unit.
Dyadic3 from_origin(const Point3& p, const ExactRay& ray) { return ray.unit * to_dyadic(p) - ray.origin; }

// Returns (b - a) x (c - a).
Dyadic3 exact_cross(const Point3& a, const Point3& b, const Point3& c) {
    const Dyadic3 origin = to_dyadic(a);
    return cross(to_dyadic(b) - origin, to_dyadic(c) - origin);
}

// Let Q be the corner of a quad or triangle relative to the ray's origin, U and V the edges from it, and D the
// direction. This solves Q + u U + v V = t D. In the scalar product of both sides with V x D only u remains. With U x D
// only v remains, and with U x V only t. The quotients have a common denominator, `det`. The t of these numbers is
// multiplied by 2^t_exponent.
template <bool kQuad, class Vector>
bool hits_planar(const Vector& q, const Vector& u, const Vector& v, const Vector& d, int t_exponent,
                 const Search& search, PlanarHit& hit) {
    // A ray that starts in the plane either has t = 0 or is in the plane.
    const auto normal = cross(u, v);
    const auto height = dot(normal, q);
    if (height.sign() == 0 && search.t_min >= 0) return false;
    const auto det = dot(normal, d);
    if (det.sign() == 0 || (search.t_min >= 0 && height.sign() != det.sign())) return false;
    // Compare u and v with their limits.
    const auto is_weight = [&](const auto& w) { return w.sign() * det.sign() >= 0; };
    const auto wu = dot(cross(d, v), q), wv = dot(cross(u, d), q);
    if (!is_weight(wu) || !is_weight(wv)) return false;
    if (kQuad ? !is_weight(det - wu) || !is_weight(det - wv) : !is_weight(det - wu - wv)) return false;
    hit = {std::ldexp(ratio(height, det), t_exponent), ratio(wu, det), ratio(wv, det)};
    return search.contains(hit.t);
}

// A ray in world space as integers of fixed size, and the points and vectors of a shape.
struct FixedRay {
    FixedGrid space, along;
    Int64x3 origin, direction;

    // \pre the coordinates of the shape are at most `largest` in magnitude
    FixedRay(const Ray& ray, double largest)
        : space(larger(largest, max_abs(ray.origin))),
          along(max_abs(ray.direction)),
          origin(space(ray.origin)),
          direction(along(ray.direction)) {}

    Int64x3 from_origin(const Point3& p) { return space(p) - origin; }
    // Returns false if a number was not held exactly.
    bool is_exact() const { return space.is_exact() && along.is_exact(); }
    int t_exponent() const { return along.shift() - space.shift(); }
};

}  // namespace

bool exact_triangle(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame, const Search& search,
                    PlanarHit& hit) {
    if (frame.outer == nullptr) {
        FixedRay ray(frame.ray, larger(max_abs(a), larger(max_abs(b), max_abs(c))));
        const Int64x3 q = ray.from_origin(a), u = ray.from_origin(b) - q, v = ray.from_origin(c) - q;
        if (ray.is_exact()) return hits_planar<false>(q, u, v, ray.direction, ray.t_exponent(), search, hit);
    }
    const ExactRay ray = exact_ray(frame);
    const Dyadic3 q = from_origin(a, ray), u = from_origin(b, ray) - q, v = from_origin(c, ray) - q;
    return hits_planar<false>(q, u, v, ray.direction, 0, search, hit);
}

bool exact_quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame,
                const Search& search, PlanarHit& hit) {
    if (frame.outer == nullptr) {
        FixedRay ray(frame.ray, larger(max_abs(corner), larger(max_abs(edge_u), max_abs(edge_v))));
        const Int64x3 q = ray.from_origin(corner), u = ray.space(edge_u), v = ray.space(edge_v);
        if (ray.is_exact()) return hits_planar<true>(q, u, v, ray.direction, ray.t_exponent(), search, hit);
    }
    const ExactRay ray = exact_ray(frame);
    const Dyadic3 u = ray.unit * to_dyadic(edge_u), v = ray.unit * to_dyadic(edge_v);
    return hits_planar<true>(from_origin(corner, ray), u, v, ray.direction, 0, search, hit);
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
