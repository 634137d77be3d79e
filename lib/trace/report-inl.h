// What a query is told of a shape, intersected exactly. Per-target include guard, as Highway has it.
#if defined(LIMN_TRACE_REPORT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_REPORT_INL_H
#undef LIMN_TRACE_REPORT_INL_H
#else
#define LIMN_TRACE_REPORT_INL_H
#endif

#include "geometry/passage-inl.h"
#include "trace/shapes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

template <class Query>
HWY_INLINE Search search_of(const RayFrame& frame, const Query& query) {
    return {frame.ray.t_min, query.limit()};
}

// Reports the passages of the moved ray through a shape.
template <class Shape, class Query>
HWY_INLINE bool report_passages(const Shape& shape, const RayFrame& frame, std::uint64_t number, Query& query) {
    const auto undecided = [&] {
        if (!query.wants_touched) return;
        const bool is_on = with_numbers(shape, [&](const auto&... of) { return is_origin_on(of..., frame); });
        if (is_on) query.touch(number);
    };
    return for_each_passage(shape, frame, search_of(frame, query), undecided,
                            [&](const Passage& p) { return query.report(p, number, p.inward); });
}

// Reports the first hit of a shape, or all of them to a query that wants every hit. True if that ended the search.
template <class Shape, class Query>
HWY_INLINE bool report_hits(const Shape& shape, const RayFrame& frame, std::uint64_t number, Query& query) {
    if constexpr (Query::kMoved) {
        return report_passages(shape, frame, number, query);
    } else {
        PlanarHit hit;
        if (!intersect(shape, frame, search_of(frame, query), hit)) return false;
        return query.report(hit, number, Query::kEveryHit && is_inward(shape, frame));
    }
}

template <class Query>
HWY_INLINE bool report_hits(const SpherePredicate<double>& sphere, const RayFrame& frame, std::uint64_t number,
                            Query& query) {
    if constexpr (Query::kMoved) {
        return report_passages(sphere, frame, number, query);
    } else if constexpr (Query::kEveryHit) {
        const SphereHits hits = sphere.hits(frame, search_of(frame, query));
        return (hits.near_found && query.report({hits.near, 0, 0}, number, sphere.radius > 0)) ||
               (hits.far_found && query.report({hits.far, 0, 0}, number, sphere.radius < 0));
    } else {
        PlanarHit hit;
        return intersect(sphere, frame, search_of(frame, query), hit) && query.report(hit, number, false);
    }
}

template <class Kind, class Query>
HWY_INLINE bool report_hits(std::reference_wrapper<const Kind> row, const RayFrame& frame, std::uint64_t number,
                            Query& query) {
    PlanarHit hit;
    for (Search rest = search_of(frame, query); row.get().intersect(frame, rest, hit); rest.t_min = hit.t) {
        bool inward = false;
        if constexpr (Query::kEveryHit) {
            Surface surface;
            row.get().surface(frame.ray, hit, false, surface);
            inward = dot(Vec3(surface.normal), frame.ray.direction) < 0;
        }
        const bool end = query.report(hit, number, inward);
        if (end || !Query::kEveryHit) return end;
    }
    return false;
}

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
