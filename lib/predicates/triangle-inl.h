// Ray against triangle. Per-target include guard, as Highway has it.
#if defined(LIMN_PREDICATES_TRIANGLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_PREDICATES_TRIANGLE_INL_H
#undef LIMN_PREDICATES_TRIANGLE_INL_H
#else
#define LIMN_PREDICATES_TRIANGLE_INL_H
#endif

#include "predicates/exact.h"
#include "predicates/planar-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

template <class N>
struct TrianglePredicate {
    using Ray = ShearedRay<N>;
    static constexpr std::size_t kNumbers = 9;
    Vector<N> a, b, c;

    // number(i): the i-th of kNumbers.
    template <class Number>
    HWY_INLINE static TrianglePredicate from(const Number& number) {
        return {three<N>(number, 0), three<N>(number, 3), three<N>(number, 6)};
    }
    HWY_INLINE Vector<N> outward() const { return cross(b - a, c - a); }

    // u and v are the weights of b and c. A point of an edge belongs to the triangle, a ray in its plane misses.
    //
    // The edge values w are determinants of sheared vertices, off by at most e (ShearedRay). If all three lie beyond e
    // on the same side, the ray passes through the inside; if two lie beyond it on different sides, it passes by.
    //
    // The weights w / (wa + wb + wc) are off by at most 5 e / |wa + wb + wc|: e from w, 3 e from the sum, whose own two
    // roundings are less than e. As computed they add up to 1, so that in the mean z only differences of z see that
    // error, those of two vertices to the third.
    HWY_INLINE FilterResult<N> filter(const Ray& ray, const Interval<N>& within) const {
        const Vector<N> at_a = ray.axes.permuted(a), at_b = ray.axes.permuted(b), at_c = ray.axes.permuted(c);
        const Vector<N> qa = at_a - ray.origin, qb = at_b - ray.origin, qc = at_c - ray.origin;
        const Vector<N> pa = ray.sheared(qa), pb = ray.sheared(qb), pc = ray.sheared(qc);
        const N wa = pc.x * pb.y - pc.y * pb.x;
        const N wb = pa.x * pc.y - pa.y * pc.x;
        const N wc = pb.x * pa.y - pb.y * pa.x;
        const N least = min(wa, min(wb, wc)), most = max(wa, max(wb, wc));
        const N reach = max(max_abs(qa), max(max_abs(qb), max_abs(qc)));
        const N e = ray.determinant_error(reach, across(pa, pb, pc));
        const Mask<N> inside = (least > e) | (most < -e), missed = (least < -e) & (most > e);
        if (!any(inside)) return {inside, missed, N(0.0), N(0.0), N(0.0)};

        const N det = wa + wb + wc;
        const InsideHit<N> h{.z = (wa * pa.z + wb * pb.z + wc * pc.z) / det,
                             .u = wb / det,
                             .v = wc / det,
                             .coordinate_error = ray.coordinate_error(reach),
                             .weight_error = 5 * e / abs(det),
                             .depth = max(pa.z, max(pb.z, pc.z)) - min(pa.z, min(pb.z, pc.z))};
        FilterResult<N> result = judged(ray, within, missed, inside, h);
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

// The same in all lanes.
template <class N>
HWY_INLINE TrianglePredicate<N> triangle_of(const Point3& a, const Point3& b, const Point3& c) {
    return {broadcast<N>(a), broadcast<N>(b), broadcast<N>(c)};
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
