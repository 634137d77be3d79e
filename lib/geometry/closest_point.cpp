#include "geometry/closest_point.h"

#include <algorithm>
#include <cmath>

#include "geometry/dyadic.h"
#include "limn/math/frame.h"
#include "limn/math/math.h"

namespace limn {

namespace {

using Part = NearestPoint::Part;

// These overloads let find_part() work on double and on Dyadic.
int sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
int sign(const Dyadic& x) { return x.sign(); }
double quotient(double a, double b) { return a / b; }
double quotient(const Dyadic& a, const Dyadic& b) { return ratio(a, b); }

// Finds the part of the triangle that is nearest to the origin, and u and v of the nearest point: Ericson, Real-Time
// Collision Detection, 2005, section 5.1.5, for numbers N and vectors V. Returns false if the triangle has no area.
template <class N, class V>
bool find_part(const V& a, const V& b, const V& c, NearestPoint& nearest) {
    const V ab = b - a, ac = c - a;
    const N d1 = -dot(ab, a), d2 = -dot(ac, a), d3 = -dot(ab, b), d4 = -dot(ac, b), d5 = -dot(ab, c), d6 = -dot(ac, c);
    const auto found = [&](Part part, double u, double v) {
        nearest.part = part;
        nearest.u = u;
        nearest.v = v;
        return true;
    };
    // Test the region of each vertex, then that of each edge.
    if (sign(d1) <= 0 && sign(d2) <= 0) return found(Part::a, 0, 0);
    if (sign(d3) >= 0 && sign(d4 - d3) <= 0) return found(Part::b, 1, 0);
    if (sign(d6) >= 0 && sign(d5 - d6) <= 0) return found(Part::c, 0, 1);
    const N vc = d1 * d4 - d3 * d2;
    if (sign(vc) <= 0 && sign(d1) >= 0 && sign(d3) <= 0) return found(Part::edge_ab, quotient(d1, d1 - d3), 0);
    const N vb = d5 * d2 - d1 * d6;
    if (sign(vb) <= 0 && sign(d2) >= 0 && sign(d6) <= 0) return found(Part::edge_ac, 0, quotient(d2, d2 - d6));
    const N va = d3 * d6 - d5 * d4, along = d4 - d3, back = d5 - d6;
    if (sign(va) <= 0 && sign(along) >= 0 && sign(back) >= 0) {
        const double w = quotient(along, along + back);
        return found(Part::edge_bc, 1 - w, w);
    }
    // The nearest point is inside the triangle; find its weights.
    const N sum = va + vb + vc;
    if (sign(sum) == 0) return false;
    return found(Part::face, quotient(vb, sum), quotient(vc, sum));
}

}  // namespace

// Let `edge` be the length of the longest edge, n the cross product of two edges, and `reach` the largest distance of a
// vertex. In double the weights are off by about 2^-50 edge^3 reach / |n|^2. As long as edge^4 <= 2^10 |n|^2, the point
// is therefore off by less than 2^-40 reach. For thinner triangles, whose area may round to zero, the part is found in
// exact arithmetic. The result is then exact for a triangle whose vertices are off by one rounding.
NearestPoint nearest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    NearestPoint nearest;
    const Vec3 ab = b - a, ac = c - a, bc = c - b, n = cross(ab, ac);
    const double edge2 = std::max({length_squared(ab), length_squared(ac), length_squared(bc)});
    // Find the part, in double if the triangle is not too thin.
    bool is_found =
        edge2 * edge2 <= 0x1p10 * length_squared(n) && edge2 > 0x1p-400 && find_part<double>(a, b, c, nearest);
    if (!is_found) is_found = find_part<Dyadic>(to_dyadic(a), to_dyadic(b), to_dyadic(c), nearest);
    if (!is_found) nearest.part = Part::a;
    // Compute the point from the weights, along an edge if it is on one.
    nearest.at = a + (nearest.u * ab + nearest.v * ac);
    if (nearest.part == Part::edge_bc) nearest.at = b + nearest.v * bc;
    if (nearest.part == Part::b) nearest.at = b;
    if (nearest.part == Part::c) nearest.at = c;
    return nearest;
}

NearestPoint nearest_on_quad(const Vec3& corner, const Vec3& edge_u, const Vec3& edge_v) {
    // The halves of the quad are two triangles that share the diagonal from at_u to at_v.
    const Vec3 at_u = corner + edge_u, at_v = corner + edge_v, across = corner + (edge_u + edge_v);
    const NearestPoint near = nearest_on_triangle(corner, at_u, at_v);
    NearestPoint far = nearest_on_triangle(across, at_v, at_u);
    far.u = 1 - far.u;
    far.v = 1 - far.v;
    NearestPoint nearest = length_squared(far.at) < length_squared(near.at) ? far : near;
    if (nearest.part == Part::edge_bc) nearest.part = Part::face;
    return nearest;
}

NearestPoint nearest_on_sphere(const Vec3& center, double radius) {
    const double way = length(center);
    NearestPoint nearest;
    nearest.at = way > 0 ? (1 - radius / way) * center : Vec3{radius, 0, 0};
    return nearest;
}

NearestPoint nearest_on_disk(const Vec3& center, const Vec3& normal, double radius) {
    const double height = dot(center, normal);
    const Vec3 aside = height * normal - center;  // from the centre to the foot of the origin on the plane
    const double way = length(aside);
    const bool is_inside = way <= radius;
    const Vec3 from_center = is_inside ? aside : (radius / way) * aside;
    const Frame axes(normal);
    return {.at = is_inside ? height * normal : center + from_center,
            .u = 0.5 + 0.5 * dot(from_center, axes.x) / radius,
            .v = 0.5 + 0.5 * dot(from_center, axes.y) / radius,
            .part = is_inside ? Part::face : Part::edge_bc};
}

}  // namespace limn
