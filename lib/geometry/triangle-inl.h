// The filter of rays against triangles. The include guard is per target, as Highway requires.
#if defined(LIMN_GEOMETRY_TRIANGLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_GEOMETRY_TRIANGLE_INL_H
#undef LIMN_GEOMETRY_TRIANGLE_INL_H
#else
#define LIMN_GEOMETRY_TRIANGLE_INL_H
#endif

#include "geometry/exact.h"
#include "geometry/planar-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// The filter of a triangle. Its edges belong to it; a ray in its plane misses.
template <class N>
struct TrianglePredicate {
    using Ray = ShearedRay<N>;
    static constexpr std::size_t kNumbers = 9;
    Vector<N> a, b, c;

    // Returns the triangle whose i-th number is number(i), i < kNumbers.
    template <class Number>
    HWY_INLINE static TrianglePredicate from(const Number& number) {
        return {three<N>(number, 0), three<N>(number, 3), three<N>(number, 6)};
    }
    // Returns the outward normal, of any length.
    HWY_INLINE Vector<N> outward() const { return cross(b - a, c - a); }

    // Returns the hits and misses that double precision can prove. u and v are the weights of b and c.
    //
    // The edge values wa, wb and wc are 2x2 determinants of sheared vertices, each off by at most e (ShearedRay). If
    // all three are above e or all three below -e, the ray passes through the inside. If one is above e and another
    // below -e, it misses. Otherwise the filter cannot decide.
    //
    // Let S = wa + wb + wc. A weight w / S is off by at most 5 e / |S|: e from w, 3 e from the terms of S, and less
    // than e from the two roundings of S. The computed weights add up to 1. Therefore only the differences z_b - z_a
    // and z_c - z_a contribute to the error of the mean z: at most 2 (5 e / |S|) depth.
    HWY_INLINE FilterResult<N> filter(const Ray& ray, const Interval<N>& within) const {
        // Shear the vertices and compute the edge values.
        const Vector<N> at_a = ray.axes.permuted(a), at_b = ray.axes.permuted(b), at_c = ray.axes.permuted(c);
        const Vector<N> qa = at_a - ray.origin, qb = at_b - ray.origin, qc = at_c - ray.origin;
        const Vector<N> pa = ray.sheared(qa), pb = ray.sheared(qb), pc = ray.sheared(qc);
        const N wa = pc.x * pb.y - pc.y * pb.x;
        const N wb = pa.x * pc.y - pa.y * pc.x;
        const N wc = pb.x * pa.y - pb.y * pa.x;
        // Decide whether the ray passes through the inside.
        const N least = min(wa, min(wb, wc)), most = max(wa, max(wb, wc));
        const N reach = max(max_abs(qa), max(max_abs(qb), max_abs(qc)));
        const N e = ray.determinant_error(reach, across(pa, pb, pc));
        const Mask<N> inside = (least > e) | (most < -e), missed = (least < -e) & (most > e);
        if (!any(inside)) return {inside, missed, N(0.0), N(0.0), N(0.0)};

        // Compute z, and compare t with the interval.
        const N det = wa + wb + wc;
        const InsideHit<N> h{.z = (wa * pa.z + wb * pb.z + wc * pc.z) / det,
                             .u = wb / det,
                             .v = wc / det,
                             .coordinate_error = ray.coordinate_error(reach),
                             .weight_error = 5 * e / abs(det),
                             .depth = max(pa.z, max(pb.z, pc.z)) - min(pa.z, min(pb.z, pc.z))};
        FilterResult<N> result = judged(ray, within, missed, inside, h);
        // If t is too uncertain, try the side of the plane on which the ray starts or ends.
        const Vector<N> edge_b = at_b - at_a, edge_c = at_c - at_a;
        const auto against = !((det < 0.0) ^ (ray.direction.z < 0.0));
        tell_by_side(ray, within, inside, edge_b, edge_c, qa, kRoundoff * max(max_abs(edge_b), max_abs(edge_c)),
                     against, result);
        return result;
    }

    bool exact(const RayFrame& frame, const Search& search, PlanarHit& hit) const {
        return exact_triangle({a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}, frame, search, hit);
    }
};

// Returns the filter of one triangle in all lanes.
template <class N>
HWY_INLINE TrianglePredicate<N> triangle_of(const Point3& a, const Point3& b, const Point3& c) {
    return {broadcast<N>(a), broadcast<N>(b), broadcast<N>(c)};
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
