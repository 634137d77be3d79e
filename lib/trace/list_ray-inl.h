// One ray against all listed primitives, a primitive in each lane. Per-target include guard, as Highway has it.
#if defined(LIMN_TRACE_LIST_RAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_LIST_RAY_INL_H
#undef LIMN_TRACE_LIST_RAY_INL_H
#else
#define LIMN_TRACE_LIST_RAY_INL_H
#endif

#include "predicates/sphere_side.h"
#include "trace/list-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// As ListPacket, but for the way the lanes go. One function, whose values stay in registers: a class with these members
// takes a sixth longer.
template <class Query>
HWY_INLINE void search_list(const flat::Scene& scene, const Ray& ray, const RayFrame& frame, Query& query) {
    const PrimitiveList& list = scene.list;
    const auto in_float = [](const auto& v) HWY_ATTR {
        return Vector<RayFloats>{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    const auto extent = static_cast<float>(flat::blas_at(scene, BlasId::root).extent);
    const ListRay seen(in_float(ray.origin), in_float(ray.direction), extent);
    if (HWY_UNLIKELY(!any(seen.is_ordinary))) {
        intersect_all_listed(scene, frame, query);
        return;
    }
    const auto limited = [](double t) {
        return static_cast<float>(larger(-double{kMostListed}, limn::smaller(double{kMostListed}, t)));
    };
    float bound = limited(query.limit());
    ListLimits limits(limited(ray.t_min), bound);
    bound = above(bound);
    const auto lower_bound = [&](float t) HWY_ATTR {
        if (t < bound) bound = t, limits.bound = t;
    };
    // Sure hits wait: those that may be the nearest are intersected at the end.
    HWY_ALIGN float near[PrimitiveList::kMost + 2 * kPacket];
    std::uint64_t waiting = 0;

    // Takes what the test of the primitives from `first` on has found; is_missed(index, lane) tells some of the others
    // for sure. True if the query has ended.
    const auto take = [&](const FloatHits<RayFloats>& hits, std::size_t first, const auto& is_missed) HWY_ATTR {
        const auto certain = hits.possible & hits.certain;
        const std::uint32_t certain_bits = Query::kEveryHit ? 0 : bits(certain);
        store(hits.near, near + first);
        if (certain_bits != 0) {
            if constexpr (Query::kFirstHit) return query.report({}, 0, false);
            waiting |= std::uint64_t{certain_bits} << first;
            lower_bound(min_of_lanes(select(certain, above(hits.far), limits.bound)));
        }
        for (std::uint32_t rest = bits(hits.possible) & ~certain_bits; rest != 0; rest &= rest - 1) {
            const auto k = static_cast<std::uint32_t>(std::countr_zero(rest));
            if (near[first + k] > bound || is_missed(list.entries[first + k], k)) continue;
            intersect_listed(scene, list.entries[first + k], frame, query);
            if (query.ended()) return true;
            lower_bound(above(limited(query.limit())));
        }
        return false;
    };

    for (std::size_t i = 0; i < list.planars(); i += kPacket) {
        const float* rows = list.planar.data() + i;
        const auto is_triangle = !first_lanes<RayFloats>(list.quads > i ? list.quads - i : 0);
        auto hits =
            test_listed_plane([&](std::size_t r) HWY_ATTR { return load<RayFloats>(rows + r * list.planar_stride); },
                              is_triangle, seen, limits);
        hits.possible = hits.possible & first_lanes<RayFloats>(list.planars() - i);
        if (!any(hits.possible)) continue;
        const auto is_missed = [&](const PrimitiveList::Entry& e, std::uint32_t k) HWY_ATTR {
            return ray.t_min >= 0 && (bits(hits.may_be_behind()) >> k & 1) != 0 &&
                   is_behind(e, broadcast<double>(ray.origin), (bits(hits.along < 0.0f) >> k & 1) != 0);
        };
        if (take(hits, i, is_missed)) return;
    }
    if (list.spheres != 0) {
        const auto ray_of_spheres = sphere_ray(seen);
        const auto is_missed = [&](const PrimitiveList::Entry& e, std::uint32_t) {
            return ray.t_min >= 0 && side_of(e.corner, e.radius, ray) == Side::missed;
        };
        for (std::size_t i = 0; i < list.spheres; i += kPacket) {
            const float* rows = list.round.data() + i;
            const auto row = [&](std::size_t r) HWY_ATTR { return load<RayFloats>(rows + r * list.sphere_stride); };
            auto hits = first_listed(listed_roots(row, ray_of_spheres), limits);
            hits.possible = hits.possible & first_lanes<RayFloats>(list.spheres - i);
            if (any(hits.possible) && take(hits, list.planars() + i, is_missed)) return;
        }
    }
    for (; waiting != 0; waiting &= waiting - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(waiting));
        if (near[k] <= bound) intersect_listed(scene, list.entries[k], frame, query);
    }
}

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
