// Triangles and quads against rays in float: many of either, with one of the other. Per-target include guard, as
// Highway has it.
#if defined(LIMN_PREDICATES_PLANAR_FLOAT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_PREDICATES_PLANAR_FLOAT_INL_H
#undef LIMN_PREDICATES_PLANAR_FLOAT_INL_H
#else
#define LIMN_PREDICATES_PLANAR_FLOAT_INL_H
#endif

#include <limits>

#include "predicates/float_hits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// ShearedRay in float: its axes are permuted, the origin is a sum of two floats. With u = 2^-24 and M the largest
// coordinate of a vertex seen from the origin, such a coordinate is off by 2 u M and by what `absolute` says; the shear
// by 4 u; a sheared coordinate, by the reasoning there, by 11 u M (2 + 2 of the coordinates, 4 of the shear, 3 of
// rounding) and twice `absolute`; products of two add 2 u P^2, P <= 2 M: E = relative M + absolute, determinants by 4
// (P + E) E.
template <class N>
struct PlanarFloatRay {
    static constexpr std::size_t kNumbers = 14;
    Vector<N> high, low;
    N shear_x, shear_y;
    N relative, absolute;
    N direction_error;  // of z, relative
    N t_from_z;
    N coarse_slope, coarse;  // the error of determinants with E for the farthest vertex: 4 E P + 4 E^2

    // number(i): the i-th of kNumbers.
    template <class Number>
    HWY_INLINE static PlanarFloatRay from(const Number& number) {
        return {three<N>(number, 0), three<N>(number, 3), number(6),  number(7),  number(8),
                number(9),           number(10),          number(11), number(12), number(13)};
    }
};

// A triangle's vertices as a ray sees them: from its origin; and sheared, but for z. Of a quad its corner and the ends
// of its edges.
template <class N>
struct SeenTriangle {
    Vector<N> a, b, c;

    // vertex(i): the i-th, its axes permuted.
    template <class Vertex>
    HWY_INLINE SeenTriangle(const Vertex& vertex, const PlanarFloatRay<N>& ray) {
        const auto seen = [&](std::size_t i) HWY_ATTR {
            const Vector<N> q = (vertex(i) - ray.high) - ray.low;
            return Vector<N>{neg_mul_add(ray.shear_x, q.z, q.x), neg_mul_add(ray.shear_y, q.z, q.y), q.z};
        };
        a = seen(0), b = seen(1), c = seen(2);
    }
};

template <class N>
struct EdgeValues {
    N wa, wb, wc, least, most;  // the last two of all that have to have one sign
    N across;                   // the largest x or y

    // With an error of e.
    HWY_INLINE Mask<N> are_missed(N e) const { return (least < -e) & (most > e); }
};

template <bool kQuad, class N>
HWY_INLINE EdgeValues<N> edge_values(const SeenTriangle<N>& p) {
    const auto difference = [](N a, N b, N c, N d) HWY_ATTR { return mul_sub(a, b, c * d); };
    EdgeValues<N> w;
    w.wa = difference(p.c.x, p.b.y, p.c.y, p.b.x);
    w.wb = difference(p.a.x, p.c.y, p.a.y, p.c.x);
    w.wc = difference(p.b.x, p.a.y, p.b.y, p.a.x);
    w.least = min(w.wb, w.wc), w.most = max(w.wb, w.wc);
    if constexpr (kQuad) {
        const N ab = 0.333f * (w.wa + w.wb), ac = 0.333f * (w.wa + w.wc);
        w.least = min(w.least, min(ab, ac)), w.most = max(w.most, max(ab, ac));
    } else {
        w.least = min(w.least, w.wa), w.most = max(w.most, w.wa);
    }
    w.across = across(p.a, p.b, p.c);
    return w;
}

// Where a plane surely lies behind the origin, of hits that are certain. A ray that leaves a surface has t close to 0
// there, which the bounds of t seldom tell from 0: the side of the plane that the origin is on does. n.q, n the normal
// and q from the origin to a vertex, is off by 16 u of the sum of the magnitudes of its products: 5 u from the products
// of the edges, which are seen from no origin, 2 u from q, and the sum's own; and, as in is_behind, by what edges and q
// are off beside that, `absolute`.
template <class N, class Vertex>
HWY_INLINE Mask<N> is_surely_behind(const Vertex& vertex, const PlanarFloatRay<N>& ray, N det) {
    const Vector<N> a = vertex(0), u = vertex(1) - a, v = vertex(2) - a, q = (a - ray.high) - ray.low;
    N product = 0.0f, size = 0.0f;
    const auto add = [&](N u1, N v2, N u2, N v1, N along) HWY_ATTR {
        const N left = u1 * v2, right = u2 * v1;
        product = mul_add(left - right, along, product);
        size = mul_add(abs(left) + abs(right), abs(along), size);
    };
    add(u.y, v.z, u.z, v.y, q.x);
    add(u.z, v.x, u.x, v.z, q.y);
    add(u.x, v.y, u.y, v.x, q.z);
    const N edge = max(max_abs(u), max_abs(v));
    const N moved = edge * ray.absolute * mul_add(16.0f, max_abs(q), 3.0f * edge);
    const N error = mul_add(size, 16 * 0x1p-24f, moved + 0x1p-120f);
    // The normal is against the ray where det and the direction's z have the same sign; then what is behind has a
    // positive product.
    const N sign = product ^ det ^ ray.t_from_z;
    return (abs(product) > error) & (copy_sign(1.0f, sign) > 0.0f);
}

// The vertices are A, B, C; a quad is A + u (B - A) + v (C - A). Edge values as in TrianglePredicate, each off by at
// most e: all beyond e on one side are a hit, two beyond it on different sides a miss. The edges of a quad are wb, wc,
// wa + wb and wa + wc, the sums off by 3 e.
//
// Where a hit is certain its weights are off by 5 e / |det|, so z by twice that times the depth, by E, and by 24
// roundings of z, of which there are 64 in 4 E; t by that, and the bounds' own rounding. Where it is not, z lies
// between that of the vertices, for a quad as far again.
//
// vertex(i): the i-th, its axes permuted. `leaving`: where nothing behind the origin counts.
template <bool kQuad, class N, class Vertex>
HWY_INLINE FloatHits<N> test_planar(const Vertex& vertex, const PlanarFloatRay<N>& ray, Mask<N> there, Mask<N> leaving,
                                    const Interval<N>& within) {
    const SeenTriangle<N> p(vertex, ray);
    const EdgeValues<N> w = edge_values<kQuad>(p);
    FloatHits<N> hits;
    // The bound for vertices as far away as there are any tells most misses, sooner.
    hits.possible = there & !w.are_missed(mul_add(ray.coarse_slope, w.across, ray.coarse));
    if (HWY_LIKELY(!any(hits.possible))) return hits;

    const N largest_z = max(abs(p.a.z), max(abs(p.b.z), abs(p.c.z)));
    const N coordinate_error = mul_add(ray.relative, w.across + largest_z, ray.absolute);
    const N e = 4.0f * (w.across + coordinate_error) * coordinate_error;
    const N det = w.wa + (w.wb + w.wc), inverse = 1.0f / det;
    const N mean = mul_add(w.wa, p.a.z, mul_add(w.wb, p.b.z, w.wc * p.c.z)) * inverse;
    // Finite on the side of the other: infinity less an infinite error would be a NaN, which min and max may pass over.
    constexpr float kMost = std::numeric_limits<float>::max();
    const N lowest = min(min(p.a.z, min(p.b.z, p.c.z)), N(kMost));
    const N highest = max(max(p.a.z, max(p.b.z, p.c.z)), N(-kMost)), depth = highest - lowest;
    const N weight_error = 10.0f * e * abs(inverse), e4 = 4.0f * coordinate_error;
    const N z_error = mul_add(weight_error, depth, mul_add(ray.direction_error, abs(mean), e4));
    const N around = kQuad ? depth + e4 : e4;
    hits.certain = (w.least > e) | (w.most < -e);
    const N t1 = ray.t_from_z * select(hits.certain, mean - z_error, lowest - around);
    const N t2 = ray.t_from_z * select(hits.certain, mean + z_error, highest + around);
    hits.near = min(t1, t2), hits.far = max(t1, t2);
    // Where nothing is known there is a NaN, and no comparison drops it.
    hits.possible = hits.possible & !(w.are_missed(e) | (hits.near > within.t_max) | (hits.far < within.t_min));
    const auto is_close = hits.possible & leaving & (hits.near < 0.0f);
    if (any(is_close)) hits.possible = hits.possible & !(hits.certain & leaving & is_surely_behind(vertex, ray, det));
    return hits;
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
