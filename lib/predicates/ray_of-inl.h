// A ray, or one in each lane, and what the filters say of it. Per-target include guard, as Highway has it.
#if defined(LIMN_PREDICATES_RAY_OF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_PREDICATES_RAY_OF_INL_H
#undef LIMN_PREDICATES_RAY_OF_INL_H
#else
#define LIMN_PREDICATES_RAY_OF_INL_H
#endif

#include "lanes/lanes-inl.h"
#include "predicates/coordinate.h"
#include "predicates/filter.h"
#include "predicates/ray_frame.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

template <class N>
struct RayOf {
    Vector<N> origin, direction;
    N origin_error, direction_error;  // RayFrame's
};

template <class N>
HWY_INLINE RayOf<N> ray_of(const RayFrame& frame) {
    return {broadcast<N>(frame.ray.origin), broadcast<N>(frame.ray.direction), N(frame.origin_error),
            N(frame.direction_error)};
}

// Where hits may lie: see Search.
template <class N>
struct Interval {
    N t_min, t_max;
};

// number(i), number(i + 1) and number(i + 2).
template <class N, class Number>
HWY_INLINE Vector<N> three(const Number& number, std::size_t i) {
    return {number(i), number(i + 1), number(i + 2)};
}

// What a filter finds.
template <class N>
struct FilterResult {
    Mask<N> hit, miss;  // neither: undecided
    N t, u, v;          // of hits
};

// What is known of a t that is off by at most some error. It is beyond the search for sure; or it is accurate, so that
// it is the one to report. Not where the exact one may be a float32 that it just misses: such round numbers are what
// people put into t_min and t_max. What is neither the exact fallback decides.
template <class N>
struct Judgement {
    Mask<N> beyond, accurate, within;

    HWY_INLINE Mask<N> hit() const { return accurate & within & !beyond; }
    HWY_INLINE Mask<N> miss() const { return beyond | (accurate & !within); }
};
template <class N>
HWY_INLINE Judgement<N> judge(N t, N error, const Interval<N>& within) {
    const N round = rounded_to_float(t);
    const auto misses_round = (t != round) & (abs(t - round) <= error);
    return {.beyond = Mask<N>((t - error > within.t_max) | (t + error < within.t_min)),
            .accurate = Mask<N>((error <= kAccurate * abs(t)) & !misses_round),
            .within = Mask<N>((t > within.t_min) & (t <= within.t_max) & (t < kInfinity))};
}

// A shape's numbers, the same in all lanes.
template <class N, template <class> class Predicate>
HWY_INLINE Predicate<N> in_lanes(const Predicate<double>& shape) {
    return Predicate<N>::from([&](std::size_t i) HWY_ATTR { return N(number_of<double>(shape, i)); });
}

// Exact: whether a shape is hit within the search. t, u, v as kAccurate says. `ray`: the frame's, as such shapes see
// it.
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
