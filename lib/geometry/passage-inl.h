// Passages of the moved ray (passage.h), decided by the filters if possible. The include guard is per target, as
// Highway requires.
#if defined(LIMN_GEOMETRY_PASSAGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_GEOMETRY_PASSAGE_INL_H
#undef LIMN_GEOMETRY_PASSAGE_INL_H
#else
#define LIMN_GEOMETRY_PASSAGE_INL_H
#endif

#include "geometry/passage.h"
#include "geometry/quad-inl.h"
#include "geometry/sphere-inl.h"
#include "geometry/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

HWY_INLINE Point3 to_point(const Vector<double>& p) { return {p.x, p.y, p.z}; }
HWY_INLINE Vec3 to_vec(const Vector<double>& v) { return {v.x, v.y, v.z}; }

// These call visit() with the points, vectors and numbers that define a shape.
template <class Visit>
HWY_INLINE auto with_numbers(const TrianglePredicate<double>& s, const Visit& visit) {
    return visit(to_point(s.a), to_point(s.b), to_point(s.c));
}
template <class Visit>
HWY_INLINE auto with_numbers(const QuadPredicate<double>& s, const Visit& visit) {
    return visit(to_point(s.corner), to_vec(s.edge_u), to_vec(s.edge_v));
}
template <class Visit>
HWY_INLINE auto with_numbers(const SpherePredicate<double>& s, const Visit& visit) {
    return visit(to_point(s.center), s.radius);
}

// These return limn::facing() for the plane of a shape.
HWY_INLINE int facing(const TrianglePredicate<double>& s, const RayFrame& frame) {
    return limn::facing(to_vec(s.b - s.a), to_vec(s.c - s.a), frame);
}
HWY_INLINE int facing(const QuadPredicate<double>& s, const RayFrame& frame) {
    return limn::facing(to_vec(s.edge_u), to_vec(s.edge_v), frame);
}

template <class Shape>
HWY_INLINE bool exact_passage(const Shape& shape, const RayFrame& frame, const Search& search, Passage& passage) {
    return with_numbers(shape,
                        [&](const auto&... of_shape) { return exact_passage(of_shape..., frame, search, passage); });
}

// Returns true if the ray goes against the outward normal of a flat shape that it hits.
template <class Shape>
HWY_INLINE bool is_inward(const Shape& shape, const RayFrame& frame) {
    const int side = facing(shape, frame);
    if (HWY_LIKELY(side != 0)) return side < 0;
    return with_numbers(shape, [&](const auto&... of_shape) { return exact_facing(of_shape..., frame) < 0; });
}

// Returns true if t is so far from both ends of the search that the exact t is on the same side of them. \pre the
// relative error of t is at most kAccurate
HWY_INLINE bool is_clear(double t, const Search& search) {
    const auto is_clear_of = [&](double end) {
        return !std::isfinite(end) || std::abs(t - end) > 2 * kAccurate * std::abs(t);
    };
    return is_clear_of(search.t_min) && is_clear_of(search.t_max);
}

// The result of tell(): the ray surely hits the shape within the search, surely does not, or the filter cannot decide.
enum class Told { nothing, met, missed };

// Runs the filter of a shape. Sets `hit` to the filter's t, u and v.
template <template <class> class Predicate>
HWY_INLINE Told tell(const Predicate<double>& shape, const RayFrame& frame, const Search& search, PlanarHit& hit) {
    const typename Predicate<double>::Ray ray(ray_of<double>(frame));
    const FilterResult<double> r = shape.filter(ray, {search.t_min, search.t_max});
    hit = {r.t, r.u, r.v};
    // An infinite t does not mean a miss: the exact t may just be too large for a double.
    if (!(std::abs(hit.t) < kInfinity && is_clear(hit.t, search))) return Told::nothing;
    return r.hit ? Told::met : r.miss ? Told::missed : Told::nothing;
}

// Calls report(passage) for each passage of the moved ray through a shape, until report() returns true. Returns true if
// it did. If the filter cannot decide, undecided() is called before the exact test.
template <class Shape, class Undecided, class Report>
HWY_INLINE bool for_each_passage(const Shape& shape, const RayFrame& frame, const Search& search,
                                 const Undecided& undecided, const Report& report) {
    Passage p;
    const Told told = tell(shape, frame, search, p);
    if (told == Told::missed) return false;
    const int side = told == Told::met ? facing(shape, frame) : 0;
    if (HWY_LIKELY(side != 0)) {
        p.inward = side < 0;
        return report(p);
    }
    undecided();
    return exact_passage(shape, frame, search, p) && report(p);
}

template <class Undecided, class Report>
HWY_INLINE bool for_each_passage(const SpherePredicate<double>& sphere, const RayFrame& frame, const Search& search,
                                 const Undecided& undecided, const Report& report) {
    // Try the filter: it must decide both roots.
    const SphereRoots<double> r = sphere.roots(ray_of<double>(frame));
    if (r.missed) return false;
    const Interval<double> within{search.t_min, search.t_max};
    const Judgement<double> near = judge(r.near, r.near_error, within), far = judge(r.far, r.far_error, within);
    const auto is_told = [&](const Judgement<double>& j, double t) {
        return (j.hit() || j.miss()) && is_clear(t, search);
    };
    Passage passages[2]{{{r.near, 0, 0}, sphere.radius > 0}, {{r.far, 0, 0}, sphere.radius < 0}};
    if (HWY_LIKELY(r.known && is_told(near, r.near) && is_told(far, r.far)))
        return (near.hit() && report(passages[0])) || (far.hit() && report(passages[1]));
    // Otherwise decide exactly.
    undecided();
    const int count = exact_passages(to_point(sphere.center), sphere.radius, frame, search, passages);
    return (count > 0 && report(passages[0])) || (count > 1 && report(passages[1]));
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
