// Tests of rays against triangles and quads in float: many shapes against one ray, or many rays against one shape. The
// include guard is per target, as Highway requires.
#if defined(LIMN_GEOMETRY_PLANAR_FLOAT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_GEOMETRY_PLANAR_FLOAT_INL_H
#undef LIMN_GEOMETRY_PLANAR_FLOAT_INL_H
#else
#define LIMN_GEOMETRY_PLANAR_FLOAT_INL_H
#endif

#include <limits>

#include "geometry/float_hits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// A ShearedRay in float. Its axes are permuted, and its origin is the sum of two floats, `high` and `low`. The
// derivation of the bounds is that of ShearedRay. Coordinates are those of the origin relative to the vertices, which
// are the negatives of the coordinates there; products of two of them are the same.
//
// A sheared coordinate is x = ((high.x - v.x) - shear_x (high.z - v.z)) + shift_x, where shift_x = low.x - shear_x
// low.z. Let u = 2^-24, M the largest magnitude of the coordinates of the origin relative to a vertex, and R the
// largest magnitude of the coordinates of the origin and the vertices.
//   - high - v is off by u M, its rounding, plus an absolute error of vertex and origin.
//   - The shear is off by 4 u.
//   - |low| <= u R, so |shift_x| <= 2 u R. Its rounding, and the error of the shear times low.z, are at most 2^-45 R.
//   - Therefore a sheared coordinate is off by 11 u M + 2 x: u M from each of two coordinates, 4 u M from the shear, 3
//   u
//     M from the rounding of product and difference, 2 u M from the rounding of the last sum. Here x is the absolute
//     error, which includes those 2^-45 R.
//   - The rounding of products and differences in a determinant adds 2 u M, as in ShearedRay.
// So a sheared coordinate is off by at most E = relative M + absolute, where relative >= 13 u and absolute >= 2 x. For
// an inexact direction `relative` is larger. A determinant is off by at most 4 (P + E) E, where P is the largest
// magnitude of x and y after shearing.
template <class N>
struct PlanarFloatRay {
    static constexpr std::size_t kNumbers = 16;
    Vector<N> high;
    N relative;
    Vector<N> low;
    N absolute;
    N shear_x, shear_y;
    N t_from_z;         // t = z * t_from_z, where z is that of the origin relative to the point that is hit
    N direction_error;  // bound on the relative error of the direction's z
    N shift_x, shift_y;
    // The bound on the error of determinants for the farthest possible vertex is coarse_slope P + coarse, that is 4 E P
    // + 4 E^2.
    N coarse_slope, coarse;

    // Returns the ray whose i-th number is number(i), i < kNumbers.
    template <class Number>
    HWY_INLINE static PlanarFloatRay from(const Number& number) {
        return {three<N>(number, 0), number(3),  three<N>(number, 4), number(7),  number(8),  number(9),
                number(10),          number(11), number(12),          number(13), number(14), number(15)};
    }
};

// The origin of a ray relative to the vertices of a triangle, sheared. The z leave `low` out and are not scaled. For a
// quad the vertices are its corner and the ends of both edges.
template <class N>
struct SeenTriangle {
    Vector<N> a, b, c;

    // vertex(i) returns the i-th vertex with permuted axes.
    template <class Vertex>
    HWY_INLINE SeenTriangle(const Vertex& vertex, const PlanarFloatRay<N>& ray) {
        const auto seen = [&](std::size_t i) HWY_ATTR {
            const Vector<N> q = ray.high - vertex(i);
            return Vector<N>{neg_mul_add(ray.shear_x, q.z, q.x) + ray.shift_x,
                             neg_mul_add(ray.shear_y, q.z, q.y) + ray.shift_y, q.z};
        };
        a = seen(0);
        b = seen(1);
        c = seen(2);
    }
};

// The edge values of a triangle or quad: see test_planar().
template <class N>
struct EdgeValues {
    N wa, wb, wc;
    N least, most;  // smallest and largest of the values that must have the same sign if the shape is hit
    N across;       // P: the largest magnitude of x and y

    // Returns true if the ray surely misses, given that each value is off by at most e.
    HWY_INLINE Mask<N> are_missed(N e) const { return (least < -e) & (most > e); }
};

// Computes the edge values. Those of a quad that are sums of two are off by 3 e. They are scaled by 0.333, so that they
// are off by at most e, too.
template <bool kQuad, class N>
HWY_INLINE EdgeValues<N> edge_values(const SeenTriangle<N>& p) {
    const auto difference = [](N a, N b, N c, N d) HWY_ATTR { return mul_sub(a, b, c * d); };
    EdgeValues<N> w;
    w.wa = difference(p.c.x, p.b.y, p.c.y, p.b.x);
    w.wb = difference(p.a.x, p.c.y, p.a.y, p.c.x);
    w.wc = difference(p.b.x, p.a.y, p.b.y, p.a.x);
    w.least = min(w.wb, w.wc);
    w.most = max(w.wb, w.wc);
    if constexpr (kQuad) {
        const N ab = 0.333f * (w.wa + w.wb), ac = 0.333f * (w.wa + w.wc);
        w.least = min(w.least, min(ab, ac));
        w.most = max(w.most, max(ab, ac));
    } else {
        w.least = min(w.least, w.wa);
        w.most = max(w.most, w.wa);
    }
    w.across = across(p.a, p.b, p.c);
    return w;
}

// Returns true if the plane of a shape is surely behind the ray's origin. \pre the hit is certain; `det` is the sum of
// its edge values
//
// A ray that starts on a surface needs this test for that surface: the t of the hit is so close to 0 that the bounds on
// t seldom exclude t > 0. The side of the plane on which the origin is decides more often.
//
// Let n = u x v be the normal and q the vector from a vertex to the origin. n.q is a sum of products of three numbers.
// Its error is at most the sum of
//   - 16 u times the sum of the magnitudes of these products, u = 2^-24. This covers the rounding: 5 u for a difference
//     of products of edges (u and v are differences of vertices, not relative to the origin), 2 u for q, and the rest
//     for the sum.
//   - the effect of the absolute errors x of vertices and origin. As in is_behind() with edge errors 2 x <= absolute
//     and an error of q of absolute / 2, this is edge absolute (16 |q| + 3 edge).
template <class N, class Vertex>
HWY_INLINE Mask<N> is_surely_behind(const Vertex& vertex, const PlanarFloatRay<N>& ray, N det) {
    // Compute n.q and the sum of the magnitudes of its products.
    const Vector<N> a = vertex(0), u = vertex(1) - a, v = vertex(2) - a, q = (ray.high - a) + ray.low;
    N product = 0.0f, size = 0.0f;
    const auto add = [&](N u1, N v2, N u2, N v1, N along) HWY_ATTR {
        const N left = u1 * v2, right = u2 * v1;
        product = mul_add(left - right, along, product);
        size = mul_add(abs(left) + abs(right), abs(along), size);
    };
    add(u.y, v.z, u.z, v.y, q.x);
    add(u.z, v.x, u.x, v.z, q.y);
    add(u.x, v.y, u.y, v.x, q.z);
    // Compute the bound on the error of n.q.
    const N edge = max(max_abs(u), max_abs(v));
    const N moved = edge * ray.absolute * mul_add(16.0f, max_abs(q), 3.0f * edge);
    const N error = mul_add(size, 16 * 0x1p-24f, moved + 0x1p-120f);
    // The plane is behind the origin if n.q and n.d have the same sign. n.d < 0 if det and the direction's z have the
    // same sign. t_from_z has the opposite sign of z.
    const N sign = product ^ det ^ ray.t_from_z;
    return (abs(product) > error) & (copy_sign(1.0f, sign) > 0.0f);
}

// Tests a ray against a triangle or quad in float. vertex(i) returns the i-th vertex with permuted axes. `there` are
// the lanes to test. If `excludes_behind`, hits behind the origin do not count.
//
// Let the vertices be A, B and C. A quad is A + u (B - A) + v (C - A). The edge values wa, wb and wc are those of
// TrianglePredicate, each off by at most e. The edge values of a quad are wb, wc, wa + wb and wa + wc; the sums are off
// by 3 e. If all are above e or all below -e, the hit is certain. If one is above e and another below -e, it is a miss.
//
// Bounds on t. If the hit is certain, its weights are off by 5 e / |det| (TrianglePredicate). The error of z is the sum
// of 2 (5 e / |det|) depth, E for the z of the vertices, and 24 roundings of z, 24 u M. As E >= 16 u M, the last two
// are at most 4 E, with room for the rounding of the bounds themselves. If the hit is not certain, z is between the
// smallest and the largest z of the vertices; for a quad it may exceed them by their difference.
template <bool kQuad, class N, class Vertex>
HWY_INLINE FloatHits<N> test_planar(const Vertex& vertex, const PlanarFloatRay<N>& ray, Mask<N> there,
                                    bool excludes_behind, const Interval<N>& within) {
    const SeenTriangle<N> p(vertex, ray);
    const EdgeValues<N> w = edge_values<kQuad>(p);
    FloatHits<N> hits;
    // Try the bound for the farthest vertex first: it is quicker and finds most misses.
    hits.possible = there & !w.are_missed(mul_add(ray.coarse_slope, w.across, ray.coarse));
    if (HWY_LIKELY(!any(hits.possible))) return hits;

    // Compute E, e and the mean z. As |shear| <= 1, M is at most across + largest_z.
    const N az = p.a.z + ray.low.z, bz = p.b.z + ray.low.z, cz = p.c.z + ray.low.z;
    const N largest_z = max(abs(az), max(abs(bz), abs(cz)));
    const N coordinate_error = mul_add(ray.relative, w.across + largest_z, ray.absolute);
    const N e = 4.0f * (w.across + coordinate_error) * coordinate_error;
    const N det = w.wa + (w.wb + w.wc), inverse = 1.0f / det;
    const N mean = mul_add(w.wa, az, mul_add(w.wb, bz, w.wc * cz)) * inverse;
    // Find the range of z. An infinite bound is made finite here: below, infinity minus an infinite error would be a
    // NaN, which min and max may ignore.
    constexpr float kMost = std::numeric_limits<float>::max();
    const N lowest = min(min(az, min(bz, cz)), N(kMost));
    const N highest = max(max(az, max(bz, cz)), N(-kMost)), depth = highest - lowest;
    // Compute the bounds on t.
    const N weight_error = 10.0f * e * abs(inverse), e4 = 4.0f * coordinate_error;
    const N z_error = mul_add(weight_error, depth, mul_add(ray.direction_error, abs(mean), e4));
    const N around = kQuad ? depth + e4 : e4;
    hits.certain = (w.least > e) | (w.most < -e);
    const N t1 = ray.t_from_z * select(hits.certain, mean - z_error, lowest - around);
    const N t2 = ray.t_from_z * select(hits.certain, mean + z_error, highest + around);
    hits.near = min(t1, t2);
    hits.far = max(t1, t2);
    // Drop misses, and hits outside the search. If nothing is known, the bounds are NaN; comparisons with NaN are false
    // and drop nothing.
    hits.possible = hits.possible & !(w.are_missed(e) | (hits.near > within.t_max) | (hits.far < within.t_min));
    // Drop hits of planes behind the origin.
    if (excludes_behind && any(hits.possible & hits.certain & (hits.near < 0.0f)))
        hits.possible = hits.possible & !(hits.certain & is_surely_behind(vertex, ray, det));
    return hits;
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
