// Searches the list with one ray: a primitive in each lane. The include guard is per target, as Highway requires.
#if defined(LIMN_TRACE_LIST_RAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_LIST_RAY_INL_H
#undef LIMN_TRACE_LIST_RAY_INL_H
#else
#define LIMN_TRACE_LIST_RAY_INL_H
#endif

#include "geometry/sphere_side.h"
#include "trace/list-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// What is known of the nearest hit. Sure hits wait: those that may be the nearest are intersected exactly at the end.
struct ListedBound {
    ListLimits limits;
    float bound;
    std::uint64_t waiting = 0;

    HWY_INLINE void lower(float t) {
        bound = t < bound ? t : bound;
        limits.bound = bound;
    }
};

HWY_INLINE float limited(double t) {
    return static_cast<float>(larger(-double{kMostListed}, limn::smaller(double{kMostListed}, t)));
}

// The sure hits of the list that wait for the end of the search.
struct WaitingHits {
    std::uint64_t entries = 0;  // bit i is set for entry i
    HWY_ALIGN float near[PrimitiveList::kMost + 2 * kPacket];
};

// Takes the result of the test of the primitives from `first` on. is_missed(entry, lane) returns true for some of those
// that the ray surely misses. `near` has a number for each primitive of the list; as a member of ListedBound it would
// keep that out of registers. Returns true if the query has ended.
template <class Query, class IsMissed>
HWY_INLINE bool take_listed(const flat::Scene& scene, const FloatHits<RayFloats>& hits, std::size_t first,
                            const RayFrame& frame, Query& query, ListedBound& found, float* near,
                            const IsMissed& is_missed) {
    const auto certain = hits.possible & hits.certain;
    const std::uint32_t certain_bits = Query::kEveryHit ? 0 : bits(certain);
    store(hits.near, near + first);
    if (certain_bits != 0) {
        if constexpr (Query::kFirstHit) return query.report({}, 0, false);
        found.waiting |= std::uint64_t{certain_bits} << first;
        found.lower(min_of_lanes(select(certain, above(hits.far), found.limits.bound)));
    }
    for (std::uint32_t rest = bits(hits.possible) & ~certain_bits; rest != 0; rest &= rest - 1) {
        const auto k = static_cast<std::uint32_t>(std::countr_zero(rest));
        const PrimitiveList::Entry& e = scene.list.entries[first + k];
        if (near[first + k] > found.bound || is_missed(e, k)) continue;
        intersect_listed(scene, e, frame, query);
        if (query.ended()) return true;
        found.lower(above(limited(query.limit())));
    }
    return false;
}

// Searches the list, but for the sure hits that are left in `waiting`. Returns true if the query has ended.
template <class Query>
HWY_INLINE bool search_list(const flat::Scene& scene, const Ray& ray, const RayFrame& frame, Query& query,
                            WaitingHits& waiting) {
    // Round the ray to float.
    const PrimitiveList& list = scene.list;
    const auto in_float = [](const auto& v) HWY_ATTR {
        return Vector<RayFloats>{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    const ListRay seen(in_float(ray.origin), in_float(ray.direction),
                       static_cast<float>(flat::blas_at(scene, BlasId::root).extent));
    if (HWY_UNLIKELY(!any(seen.is_ordinary))) return intersect_all_listed(scene, frame, query);
    const float t_max = limited(query.limit());
    ListedBound found{.limits = ListLimits(limited(ray.t_min), t_max), .bound = above(t_max)};
    float* const near = waiting.near;

    // Test planar primitives, then spheres.
    for (std::size_t i = 0; i < list.planars(); i += kPacket) {
        const float* rows = list.planar.data() + i;
        const auto row = [&](std::size_t r) HWY_ATTR { return load<RayFloats>(rows + r * list.planar_stride); };
        const auto is_triangle = !first_lanes<RayFloats>(list.quads > i ? list.quads - i : 0);
        auto hits = test_listed_plane(row, is_triangle, seen, found.limits);
        hits.possible = hits.possible & first_lanes<RayFloats>(list.planars() - i);
        if (!any(hits.possible)) continue;
        const auto is_missed = [&](const PrimitiveList::Entry& e, std::uint32_t k) HWY_ATTR {
            return ray.t_min >= 0 && (bits(hits.may_be_behind()) >> k & 1) != 0 &&
                   is_behind(e, broadcast<double>(ray.origin), (bits(hits.along < 0.0f) >> k & 1) != 0);
        };
        if (take_listed(scene, hits, i, frame, query, found, near, is_missed)) return true;
    }
    if (list.spheres != 0) {
        const auto ray_of_spheres = sphere_ray(seen);
        const auto is_missed = [&](const PrimitiveList::Entry& e, std::uint32_t) {
            return ray.t_min >= 0 && side_of(e.corner, e.radius, ray) == Side::missed;
        };
        for (std::size_t i = 0; i < list.spheres; i += kPacket) {
            const float* rows = list.round.data() + i;
            const auto row = [&](std::size_t r) HWY_ATTR { return load<RayFloats>(rows + r * list.sphere_stride); };
            const auto roots = listed_roots(row, ray_of_spheres);
            if (!any(!roots.missed)) continue;
            auto hits = first_listed(roots, found.limits);
            hits.possible = hits.possible & first_lanes<RayFloats>(list.spheres - i);
            if (!any(hits.possible)) continue;
            if (take_listed(scene, hits, list.planars() + i, frame, query, found, near, is_missed)) return true;
        }
    }
    waiting.entries = found.waiting;
    if constexpr (Query::kNearest)
        if (found.waiting != 0) query.lower_limit(double{found.bound});
    return false;
}

// Intersects the sure hits that may be the nearest.
template <class Query>
HWY_INLINE void finish_list(const flat::Scene& scene, const RayFrame& frame, Query& query, WaitingHits& waiting) {
    for (; waiting.entries != 0; waiting.entries &= waiting.entries - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(waiting.entries));
        if (waiting.near[k] <= query.limit()) intersect_listed(scene, scene.list.entries[k], frame, query);
    }
}

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
