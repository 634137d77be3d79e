// The searches for one instruction set. The include guard is per target, as Highway requires.
#if defined(LIMN_TRACE_TRAVERSE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_TRAVERSE_INL_H
#undef LIMN_TRACE_TRAVERSE_INL_H
#else
#define LIMN_TRACE_TRAVERSE_INL_H
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "trace/list_packet-inl.h"
#include "trace/list_ray-inl.h"
#include "trace/searches-inl.h"
#include "trace/stream-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// The sets of kinds for which the search is compiled. A simple scene doesn't pay for kinds that it lacks.
constexpr unsigned kMeshes = flat::bit(PrimitiveKind::mesh);
constexpr unsigned kMeshesAndBoxes =
    kMeshes | flat::bit(PrimitiveKind::instance) | flat::bit(PrimitiveKind::user_defined);
constexpr unsigned kStill = flat::kPlanarKinds | flat::bit(PrimitiveKind::sphere);
constexpr unsigned kAll = ~0u;

// Calls visit() with the smallest of the sets that has all kinds of the scene. If kFew, it is kMeshes or kAll: rare
// queries are compiled for these alone.
template <bool kFew, class Visit>
HWY_INLINE void with_kinds(const flat::Scene& scene, const Visit& visit) {
    const auto covers = [&](unsigned set) { return (scene.kinds & ~set) == 0; };
    if (covers(kMeshes)) return visit(std::integral_constant<unsigned, kMeshes>{});
    if constexpr (kFew) return visit(std::integral_constant<unsigned, kAll>{});
    if (covers(kMeshesAndBoxes)) return visit(std::integral_constant<unsigned, kMeshesAndBoxes>{});
    if (covers(flat::kPlanarKinds)) return visit(std::integral_constant<unsigned, flat::kPlanarKinds>{});
    if (covers(flat::kRoundKinds)) return visit(std::integral_constant<unsigned, flat::kRoundKinds>{});
    if (covers(kStill)) return visit(std::integral_constant<unsigned, kStill>{});
    visit(std::integral_constant<unsigned, kAll>{});
}

// Searches a BLAS with any ray. An unusable ray misses. Returns true if the query ended the search.
template <class Query>
HWY_NOINLINE bool search_adapted(const flat::Scene& scene, const flat::Blas& blas, const RayFrame& frame,
                                 std::uint64_t first_number, Query& query) {
    if (!is_usable(frame.ray)) return false;
    const AdaptedRay ray(frame, blas);
    return Traversal<false, kAll, Query>(scene, blas, ray, frame, nullptr, first_number, query).run();
}

// Searches a BLAS. Returns true if the query ended the search. If kInWorld, the ray is in world space. `ray` has the
// same numbers as frame.ray. It is a parameter because vectors could not be loaded at once from a copy just made.
template <unsigned kKinds, bool kInWorld, class Query>
HWY_INLINE bool search_blas(const flat::Scene& scene, const flat::Blas& blas, [[maybe_unused]] const Ray& ray,
                            const RayFrame& frame, std::uint64_t first_number, Query& query) {
#if HWY_MAX_BYTES >= 32
    WalkRay walk_ray;
    const RayInSpace in_space = kInWorld ? ray_in_world(ray) : ray_in_space(frame);
    const float far = kInWorld || frame.outer == nullptr ? kFar : kFarInside;
    if (HWY_LIKELY((set_up<kKinds, kInWorld>(in_space, ray, blas, far, walk_ray))))
        return Traversal<true, kKinds, Query>(scene, blas, walk_ray, frame, nullptr, first_number, query).run();
#endif
    return search_adapted(scene, blas, frame, first_number, query);
}

// Searches the scene with a ray: first the list, then the tree. \pre the ray is usable if the scene has a list
template <class Query>
HWY_INLINE void search(const flat::Scene& scene, const Ray& ray, Query& query) {
    const RayFrame frame(ray);
    const bool has_list = !scene.list.empty();
    WaitingHits waiting;
    if (has_list && search_list(scene, ray, frame, query, waiting)) return;
    if (!scene.list.is_all)
        with_kinds<Query::kFewKinds>(scene, [&]<unsigned kKinds>(std::integral_constant<unsigned, kKinds>) HWY_ATTR {
            search_blas<kKinds, true>(scene, flat::blas_at(scene, BlasId::root), ray, frame, 0, query);
        });
    if (has_list) finish_list(scene, frame, query, waiting);
}
// Searches a BLAS with the ray of a frame. The primitives of the BLAS are numbered from `first_number` on.
template <class Query>
HWY_INLINE void search(const flat::Scene& scene, BlasId id, const RayFrame& frame, std::uint64_t first_number,
                       Query& query) {
    with_kinds<Query::kFewKinds>(scene, [&]<unsigned kKinds>(std::integral_constant<unsigned, kKinds>) HWY_ATTR {
        search_blas<kKinds, false>(scene, flat::blas_at(scene, id), frame.ray, frame, first_number, query);
    });
}

// Searches the tree with some rays of a batch, whose indices are `which`, in streams.
template <unsigned kKinds, class Query>
void search_in_streams(const flat::Scene& scene, const Ray* rays, std::span<const std::uint16_t> which,
                       Query* queries) {
    const flat::Blas& root = flat::blas_at(scene, BlasId::root);
#if HWY_MAX_BYTES >= 32
    // Sort the rays by the octants of their directions.
    std::array<std::uint16_t, kMostRays> order;
    std::array<std::uint8_t, kMostRays> octants;
    std::array<std::size_t, 9> first{};
    for (const std::uint16_t i : which) {
        const Vec3& d = rays[i].direction;
        octants[i] = static_cast<std::uint8_t>((std::signbit(d.x) ? 1 : 0) | (std::signbit(d.y) ? 2 : 0) |
                                               (std::signbit(d.z) ? 4 : 0));
        ++first[octants[i] + 1u];
    }
    for (std::size_t octant = 0; octant < 8; ++octant) first[octant + 1] += first[octant];
    std::array<std::size_t, 9> next = first;
    for (const std::uint16_t i : which) order[next[octants[i]]++] = i;
    // Search with the rays of each octant.
    Stream<kKinds, Query> stream(scene);
    for (std::size_t octant = 0; octant < 8; ++octant) {
        for (std::size_t k = first[octant]; k < first[octant + 1]; ++k) {
            const std::size_t i = order[k];
            if (!stream.add(rays[i], queries[i])) search_adapted(scene, root, RayFrame(rays[i]), 0, queries[i]);
            if (stream.is_full()) stream.run();
        }
        stream.run();
    }
#else
    for (const std::uint16_t i : which) search_adapted(scene, root, RayFrame(rays[i]), 0, queries[i]);
#endif
}

// Searches the scene with up to kMostRays rays: first the list, then the tree. If the rays are few, they are searched
// with one by one, by search_one(scene, ray, query).
template <class Query, class SearchOne>
void search_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Query* queries,
                 const SearchOne& search_one) {
    constexpr std::size_t kFew = 7;
    if (count <= kFew) {
        for (std::size_t i = 0; i < count; ++i) search_one(scene, rays[i], queries[i]);
        return;
    }
    // Search the list, and collect the rays that may hit what is not in it.
    std::array<std::uint16_t, kMostRays> rest;
    std::size_t rest_count = 0;
    DeferredHits deferred(scene);
    for (std::size_t first = 0; first < count; first += kPacket) {
        const std::size_t some = std::min(kPacket, count - first);
        std::uint32_t active = (1u << some) - 1;
        if (!scene.list.empty()) {
            ListPacket<Query> packet(scene, rays + first, some, queries + first);
            active = packet.run();
            if constexpr (Query::kNearest) packet.defer_candidates(deferred);
        }
        for (; active != 0; active &= active - 1)
            rest[rest_count++] = static_cast<std::uint16_t>(first + static_cast<std::size_t>(std::countr_zero(active)));
    }
    // Search the tree with those, and finish the list.
    if (rest_count != 0)
        with_kinds<false>(scene, [&]<unsigned kKinds>(std::integral_constant<unsigned, kKinds>) HWY_ATTR {
            search_in_streams<kKinds>(scene, rays, std::span(rest.data(), rest_count), queries);
        });
    deferred.finish();
}

void search_closest_of_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Closest* queries) {
    search_many(scene, rays, count, queries, search_closest);
}
void search_any_of_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Any* queries) {
    search_many(scene, rays, count, queries, search_any);
}

#define LIMN_DEFINE_SEARCH(name, Query)                                                                             \
    void name(const flat::Scene& scene, const Ray& ray, Query& query) { search(scene, ray, query); }                \
    void name##_in(const flat::Scene& scene, BlasId id, const RayFrame& frame, std::uint64_t first, Query& query) { \
        search(scene, id, frame, first, query);                                                                     \
    }
LIMN_FOR_EACH_SEARCH(LIMN_DEFINE_SEARCH)
#undef LIMN_DEFINE_SEARCH

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
