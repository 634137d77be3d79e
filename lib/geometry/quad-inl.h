// The filter of rays against parallelograms. The include guard is per target, as Highway requires.
#if defined(LIMN_GEOMETRY_QUAD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_GEOMETRY_QUAD_INL_H
#undef LIMN_GEOMETRY_QUAD_INL_H
#else
#define LIMN_GEOMETRY_QUAD_INL_H
#endif

#include "geometry/exact.h"
#include "geometry/planar-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// The filter of a parallelogram. Its border belongs to it; a ray in its plane misses.
template <class N>
struct QuadPredicate {
    using Ray = ShearedRay<N>;
    static constexpr std::size_t kNumbers = 9;
    Vector<N> corner, edge_u, edge_v;

    // Returns the quad whose i-th number is number(i), i < kNumbers.
    template <class Number>
    HWY_INLINE static QuadPredicate from(const Number& number) {
        return {three<N>(number, 0), three<N>(number, 3), three<N>(number, 6)};
    }
    // Returns the outward normal, of any length.
    HWY_INLINE Vector<N> outward() const { return cross(edge_u, edge_v); }

    // Returns the hits and misses that double precision can prove. u and v are the coordinates along the edges.
    //
    // The filter solves corner + u edge_u + v edge_v = origin in the sheared plane by Cramer's rule: u = wu / det, v =
    // wv / det. All three determinants are off by at most e (ShearedRay). det - w is off by at most 3 e, including its
    // own rounding.
    //
    // The ray hits if det is not 0 and both 0 <= w / det <= 1. Therefore |w| > |det| is a miss, even if det may be 0:
    // this decides for rays that are parallel to the plane but not in it.
    //
    // u and v are off by at most 4 e / |det|. Over the quad z changes by at most |edge_u.z| + |edge_v.z|.
    HWY_INLINE FilterResult<N> filter(const Ray& ray, const Interval<N>& within) const {
        // Shear the corner and the edges, and compute the determinants.
        const Vector<N> at_u = ray.axes.permuted(edge_u), at_v = ray.axes.permuted(edge_v);
        const Vector<N> to_corner = ray.axes.permuted(corner) - ray.origin;
        const Vector<N> q = ray.sheared(to_corner), eu = ray.sheared(at_u), ev = ray.sheared(at_v);
        N det = eu.x * ev.y - eu.y * ev.x;
        N wu = ev.x * q.y - ev.y * q.x;
        N wv = q.x * eu.y - q.y * eu.x;
        // Make det positive.
        const auto turned = det < 0.0;
        const N sign = copy_sign(N(1.0), det);
        det = abs(det);
        wu = sign * wu;
        wv = sign * wv;
        // Decide whether the ray passes through the inside.
        const N least = min(wu, wv), most = max(wu, wv);
        const N reach = max(max_abs(to_corner), max(max_abs(at_u), max_abs(at_v)));
        const N e = ray.determinant_error(reach, across(q, eu, ev));
        const Mask<N> missed = (max(-least, most) > det + 3 * e) | ((det > e) & (least < -e));
        const Mask<N> inside = (least > e) & (det - most > 3 * e);
        if (!any(inside)) return {inside, missed, N(0.0), N(0.0), N(0.0)};

        // Compute z, and compare t with the interval.
        const N u = wu / det, v = wv / det;
        const InsideHit<N> h{.z = q.z + (u * eu.z + v * ev.z),
                             .u = u,
                             .v = v,
                             .coordinate_error = ray.coordinate_error(reach),
                             .weight_error = 4 * e / det,
                             .depth = abs(eu.z) + abs(ev.z)};
        FilterResult<N> result = judged(ray, within, missed, inside, h);
        // If t is too uncertain, try the side of the plane on which the ray starts or ends.
        tell_by_side(ray, within, inside, at_u, at_v, to_corner, N(0.0), turned ^ (ray.direction.z < 0.0), result);
        return result;
    }

    bool exact(const RayFrame& frame, const Search& search, PlanarHit& hit) const {
        return exact_quad({corner.x, corner.y, corner.z}, {edge_u.x, edge_u.y, edge_u.z},
                          {edge_v.x, edge_v.y, edge_v.z}, frame, search, hit);
    }
};

// Returns the filter of one quad in all lanes.
template <class N>
HWY_INLINE QuadPredicate<N> quad_of(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v) {
    return {broadcast<N>(corner), broadcast<N>(edge_u), broadcast<N>(edge_v)};
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
