// A ray, or one ray in each lane, and the results of filters. The include guard is per target, as Highway requires.
#if defined(LIMN_GEOMETRY_RAY_OF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_GEOMETRY_RAY_OF_INL_H
#undef LIMN_GEOMETRY_RAY_OF_INL_H
#else
#define LIMN_GEOMETRY_RAY_OF_INL_H
#endif

#include "geometry/coordinate.h"
#include "geometry/filter.h"
#include "geometry/ray_frame.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// The numbers of a RayFrame that filters use.
template <class N>
struct RayOf {
    Vector<N> origin, direction;
    N origin_error, direction_error;  // bounds on the error of each coordinate: see RayFrame
};

// Returns the ray of a frame in all lanes.
template <class N>
HWY_INLINE RayOf<N> ray_of(const RayFrame& frame) {
    return {broadcast<N>(frame.ray.origin), broadcast<N>(frame.ray.direction), N(frame.origin_error),
            N(frame.direction_error)};
}

// The interval in which hits are searched: see Search.
template <class N>
struct Interval {
    N t_min, t_max;
};

// Returns the vector of number(i), number(i + 1) and number(i + 2).
template <class N, class Number>
HWY_INLINE Vector<N> three(const Number& number, std::size_t i) {
    return {number(i), number(i + 1), number(i + 2)};
}

// The result of a filter.
template <class N>
struct FilterResult {
    Mask<N> hit, miss;  // sure hits and sure misses; undecided if neither is set
    N t, u, v;          // of hits
};

// The judgement of a t with a bound on its error: see judge().
//
// If t is neither `beyond` nor `accurate`, the exact fallback decides. If the computed t isn't a float but a float is
// within its error, the exact t may be that float. t_min or t_max may be the same float, since they are often floats.
// Such a t isn't accurate.
template <class N>
struct Judgement {
    Mask<N> beyond;    // the exact t is surely outside the search
    Mask<N> accurate;  // t may be reported
    Mask<N> within;    // t as computed is within the search

    HWY_INLINE Mask<N> hit() const { return accurate & within & !beyond; }
    HWY_INLINE Mask<N> miss() const { return beyond | (accurate & !within); }
};
// Judges a t that is off by at most `error`.
template <class N>
HWY_INLINE Judgement<N> judge(N t, N error, const Interval<N>& within) {
    const N round = rounded_to_float(t);
    const auto misses_round = (t != round) & (abs(t - round) <= error);
    return {.beyond = Mask<N>((t - error > within.t_max) | (t + error < within.t_min)),
            .accurate = Mask<N>((error <= kAccurate * abs(t)) & !misses_round),
            .within = Mask<N>((t > within.t_min) & (t <= within.t_max) & (t < kInfinity))};
}

// Returns the filter of one shape in all lanes.
template <class N, template <class> class Predicate>
HWY_INLINE Predicate<N> in_lanes(const Predicate<double>& shape) {
    return Predicate<N>::from([&](std::size_t i) HWY_ATTR { return N(number_of<double>(shape, i)); });
}

// Returns true if the ray hits the shape within the search. This decision is exact. If true, t, u and v are set, as
// accurate as kAccurate and kAccurateWeight demand. `ray` is the ray of `frame` in the form that the filter uses.
template <template <class> class Predicate>
HWY_INLINE bool intersect(const Predicate<double>& shape, const typename Predicate<double>::Ray& ray,
                          const RayFrame& frame, const Search& search, PlanarHit& hit) {
    const FilterResult<double> r = shape.filter(ray, {search.t_min, search.t_max});
    hit = {r.t, r.u, r.v};
    if (HWY_LIKELY(r.hit)) return true;
    return HWY_UNLIKELY(!r.miss) && shape.exact(frame, search, hit);
}
template <template <class> class Predicate>
HWY_INLINE bool intersect(const Predicate<double>& shape, const RayFrame& frame, const Search& search, PlanarHit& hit) {
    return intersect(shape, typename Predicate<double>::Ray(ray_of<double>(frame)), frame, search, hit);
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
