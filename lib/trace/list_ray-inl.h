// One ray against all listed primitives, a primitive in each lane. Per-target include guard, as Highway has it.
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

// What a ray knows of its nearest hit. Sure hits wait: those that may be the nearest are intersected at the end.
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

// Takes what the test of the primitives from `first` on has found; is_missed(index, lane) tells some of the others for
// sure. `near`: of all primitives; a member of ListedBound would keep that out of registers. True if the query has
// ended.
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

// As ListPacket, but for the way the lanes go. search_rest() searches what is not listed.
template <class Query, class SearchRest>
HWY_INLINE void search_list(const flat::Scene& scene, const Ray& ray, const RayFrame& frame, Query& query,
                            const SearchRest& search_rest) {
    const PrimitiveList& list = scene.list;
    const auto in_float = [](const auto& v) HWY_ATTR {
        return Vector<RayFloats>{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    const ListRay seen(in_float(ray.origin), in_float(ray.direction),
                       static_cast<float>(flat::blas_at(scene, BlasId::root).extent));
    if (HWY_UNLIKELY(!any(seen.is_ordinary))) {
        if (!intersect_all_listed(scene, frame, query)) search_rest();
        return;
    }
    const float t_max = limited(query.limit());
    ListedBound found{.limits = ListLimits(limited(ray.t_min), t_max), .bound = above(t_max)};
    HWY_ALIGN float near[PrimitiveList::kMost + 2 * kPacket];

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
        if (take_listed(scene, hits, i, frame, query, found, near, is_missed)) return;
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
            if (take_listed(scene, hits, list.planars() + i, frame, query, found, near, is_missed)) return;
        }
    }
    if constexpr (Query::kNearest)
        if (found.waiting != 0) query.lower_limit(double{found.bound});
    search_rest();
    for (; found.waiting != 0; found.waiting &= found.waiting - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(found.waiting));
        if (near[k] <= query.limit()) intersect_listed(scene, list.entries[k], frame, query);
    }
}

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
