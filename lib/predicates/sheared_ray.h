// A ray as triangles and quads see it.
#pragma once

#include <cmath>
#include <cstddef>

#include "limn/core/vec.h"
#include "predicates/filter.h"
#include "predicates/ray_frame.h"

namespace limn {

// The axes are permuted so that the direction is largest along z; shearing maps it onto z, so that a triangle is hit
// where the origin lies inside its projection (Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2(1),
// 2013; here in double).
//
// Error of a sheared coordinate p = fl(A_x - fl(S A_z)), where A = fl(a - o) has no coordinate above M, |S| <= 1, u =
// 2^-53, the origin is off by e and S by s: u M + e from A_x; (u + s) M + (u M + e) from S A_z; u M from that product;
// 2 u M from the difference: (6 u + s) M + 2 e in all. Products of two such coordinates, no larger than P, and their
// difference lose 2 u P^2 each; P <= 2 M. So with E = (8 u + s) M + 2 e every 2x2 determinant is off by at most 4 (P +
// E) E. An edge vector, which is not a difference, loses less.
struct ShearedRay {
    std::size_t x, y, z;
    double shear_x, shear_y;
    double direction_z;
    Point3 origin;
    double relative, absolute;  // E = relative M + absolute
    double direction_error;     // of direction_z, relative
    double coarse;              // bound on the error of all determinants
    const RayFrame* frame;      // kept by reference

    // `extent`: no shape to come has a larger coordinate. With it most misses are told by `coarse`, sooner.
    explicit ShearedRay(const RayFrame& f, double extent = kInfinity) : origin(f.ray.origin), frame(&f) {
        const Vec3& direction = f.ray.direction;
        const Vec3 d = abs(direction);
        z = d.x > d.y ? (d.x > d.z ? 0 : 2) : (d.y > d.z ? 1 : 2);
        x = z == 2 ? 0 : z + 1;
        y = x == 2 ? 0 : x + 1;
        direction_z = direction[z];
        shear_x = direction[x] / direction_z;
        shear_y = direction[y] / direction_z;
        // |d_x / d_z - (d_x + e) / (d_z + e')| <= 2 e / (|d_z| - e); 4 e / |d_z| as long as that is below 1/2.
        direction_error = f.direction_error == 0 ? 0 : 4 * f.direction_error / std::abs(direction_z);
        if (!(direction_error < 0.5)) direction_error = kInfinity;
        relative = (8 * kRoundoff + direction_error) * (1 + 0x1p-30);
        absolute = 2 * f.origin_error * (1 + direction_error) * (1 + 0x1p-30);              // |S| <= 1 + s
        const double reach = 2 * extent + largest_magnitude(origin.x, origin.y, origin.z);  // of edges too
        coarse = determinant_error(reach, 2 * reach);
    }

    // Of a sheared coordinate, and of a 2x2 determinant of them: E and 4 (P + E) E. `reach`: the largest coordinate
    // before shearing; `across`: the largest x or y after it. Infinite, so that nothing is decided, where products of
    // three coordinates could overflow, or underflow by more than the bound.
    double coordinate_error(double reach) const { return relative * reach + absolute; }
    double determinant_error(double reach, double across) const {
        const double e = coordinate_error(reach);
        return reach > 0x1p-300 && reach < 0x1p300 ? 4 * (across + e) * e + 0x1p-600 : kInfinity;
    }

    // z is left as it is: dividing by direction_z turns it into t.
    Vec3 shear(const Vec3& v) const { return {v[x] - shear_x * v[z], v[y] - shear_y * v[z], v[z]}; }
};

struct PlanarHit {
    double t, u, v;
};

// What a filter finds.
struct PlanarAnswer {
    Decision decision;
    PlanarHit hit{};
};

// Whether a plane lies behind the ray's origin: a surface behind the ray that leaves it, which the t of a search, close
// to 0, seldom tells. `product` is n.q, n the normal and q from the origin to a point of the plane, both computed, and
// `against` whether n.d < 0. `edge` is the largest coordinate of the edges that n is the cross product of, each
// of which is off by at most `edge_error`; then n is off by 4 edge edge_error + 4 u edge^2 and less than a third of the
// former, and n.q by three times that times |q|, 6 edge^2 (u |q| + e) from q, and 18 u edge^2 |q| from the products.
inline bool is_behind(const ShearedRay& ray, double product, bool against, double edge, double edge_error, double q) {
    const double error =
        edge * (16 * edge_error * q + edge * (36 * kRoundoff * q + 3 * ray.absolute)) * (1 + 0x1p-30) + 0x1p-900;
    return std::abs(product) > error && (product < 0) != against;
}

// Whether a plane lies beyond the end of a search: that of a lamp, whose shadow rays end just before it, and which from
// beside it the t of a search does not tell. The end is seen from q, from the origin to a point of the plane; the
// edges u and v are off by their own rounding, q - t_max d by 3 u (|q| + t_max |d|), the rest is as above. That is far
// more than what t is rounded by. Only for rays as they were given.
inline bool is_beyond(const ShearedRay& ray, const Vec3& u, const Vec3& v, const Vec3& q, bool against, double t_max) {
    if (!(t_max < kInfinity) || ray.absolute != 0 || ray.direction_error != 0) return false;
    const Vec3 way = t_max * ray.frame->ray.direction, rest = q - way;
    const double edge = larger(max_abs(u), max_abs(v));
    const double product = dot(cross(u, v), rest);
    const double error =
        edge * edge * kRoundoff * (52 * max_abs(rest) + 18 * (max_abs(q) + max_abs(way))) * (1 + 0x1p-30) + 0x1p-900;
    return std::abs(product) > error && (product < 0) == against;
}

// The hit at depth `z`, computed as a weighted mean by at most 8 operations; its weights are off by `weight_error`, u
// and v among them. Over the shape z varies by `depth`.
inline PlanarAnswer planar_answer(const ShearedRay& ray, double coordinate_error, double weight_error, double depth,
                                  double z, double u, double v, const Search& search) {
    const double z_error = 2 * (weight_error * depth + coordinate_error) + ray.direction_error * std::abs(z);
    const Approximate t{z / ray.direction_z, z_error / std::abs(ray.direction_z)};
    return {in_search(t, search, !(weight_error <= kAccurateWeight)), {t.value, u, v}};
}

}  // namespace limn
