// The searches for one instruction set. Per-target include guard, as Highway has it.
#if defined(LIMN_TRACE_TRAVERSE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_TRAVERSE_INL_H
#undef LIMN_TRACE_TRAVERSE_INL_H
#else
#define LIMN_TRACE_TRAVERSE_INL_H
#endif

#include <algorithm>
#include <array>
#include <optional>

#include "trace/list_packet-inl.h"
#include "trace/list_ray-inl.h"
#include "trace/packet-inl.h"
#include "trace/searches-inl.h"
#include "trace/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

template <class... Kinds>
constexpr unsigned kinds(Kinds... kind) {
    return (flat::bit(kind) | ...);
}

// The sets of kinds that have code of their own. Simple scenes do not pay for what only others need.
constexpr unsigned kMeshes = kinds(PrimitiveKind::mesh);
constexpr unsigned kMeshesAndBoxes = kinds(PrimitiveKind::mesh, PrimitiveKind::instance, PrimitiveKind::user_defined);
constexpr unsigned kSpheres = kinds(PrimitiveKind::sphere, PrimitiveKind::moving_sphere);
constexpr unsigned kStill =
    kinds(PrimitiveKind::sphere, PrimitiveKind::triangle, PrimitiveKind::quad, PrimitiveKind::mesh);
constexpr unsigned kAll = ~0u;

// visit(the smallest of the sets that has all kinds of the scene). kFew: of meshes and all, for rarer queries.
template <bool kFew, class Visit>
HWY_INLINE void with_kinds(const flat::Scene& scene, const Visit& visit) {
    const auto covers = [&](unsigned set) { return (scene.kinds & ~set) == 0; };
    if (covers(kMeshes)) return visit(std::integral_constant<unsigned, kMeshes>{});
    if constexpr (kFew) return visit(std::integral_constant<unsigned, kAll>{});
    if (covers(kMeshesAndBoxes)) return visit(std::integral_constant<unsigned, kMeshesAndBoxes>{});
    if (covers(flat::kPlanarKinds)) return visit(std::integral_constant<unsigned, flat::kPlanarKinds>{});
    if (covers(kSpheres)) return visit(std::integral_constant<unsigned, kSpheres>{});
    if (covers(kStill)) return visit(std::integral_constant<unsigned, kStill>{});
    visit(std::integral_constant<unsigned, kAll>{});
}

template <unsigned kKinds, class Query>
HWY_INLINE void search_blas(const flat::Scene& scene, const flat::Blas& blas, const Ray& ray, const RayFrame& frame,
                            std::uint64_t first_number, Query& query, DeferredHits* deferred) {
    BoxRay box;
    set_up(ray, frame, blas, box);
    Traversal<kKinds, Query>(scene, blas, box, frame, first_number, query, deferred).run();
}

template <class Query>
void search(const flat::Scene& scene, BlasId id, const Ray& ray, const RayFrame& frame, std::uint64_t first_number,
            Query& query) {
    const auto search_tree = [&] {
        const flat::Blas& blas = flat::blas_at(scene, id);
        with_kinds<Query::kFewKinds>(scene, [&]<unsigned kKinds>(std::integral_constant<unsigned, kKinds>) HWY_ATTR {
            search_blas<kKinds>(scene, blas, ray, frame, first_number, query, nullptr);
        });
    };
    if (id != BlasId::root || scene.list.empty()) return search_tree();
    search_list(scene, ray, frame, query, [&] {
        if (!scene.list.is_all) search_tree();
    });
}

constexpr float kPacketTriangles = 4;  // across; 4 x 4 are as many as a packet has lanes

// The largest difference of directions, relative to one, and of origins, relative to the extent, of rays that are
// traced as a packet: over more triangles than there are lanes it does more work than its rays one by one.
float packet_spread(const flat::Scene& scene) {
    const auto across = std::sqrt(static_cast<float>(scene.stored_primitives));  // triangles from side to side
    return std::min(1 / 16.0f, kPacketTriangles / across);
}

// Whether the rays go much the same way, so that they meet much the same boxes.
bool are_alike(const Ray* rays, std::size_t count, float spread, const flat::Blas& root) {
    const Ray& first = rays[0];
    const double near = double{spread} * max_abs(first.direction), beside = double{spread} * root.extent;
    for (std::size_t i = 1; i < count; ++i)
        if (!(max_abs(rays[i].direction - first.direction) < near && max_abs(rays[i].origin - first.origin) < beside))
            return false;
    return true;
}

// Rays that go different ways, some at a time by turns: while what one needs comes from memory, others go on.
template <class Query>
class Interleaved {
public:
    Interleaved(const flat::Scene& scene, DeferredHits* deferred)
        : scene_(scene), root_(flat::blas_at(scene, BlasId::root)), deferred_(deferred) {}

    HWY_INLINE void add(const Ray& ray, Query& query) {
        if (root_.root == flat::kNothing) return;
        while (active_ == kSlots) turn();
        Slot& slot = slots_[order_[active_++]];
        slot.frame.emplace(ray);
        set_up(ray, *slot.frame, root_, slot.box);
        slot.traversal = new (slot.storage) One(scene_, root_, slot.box, *slot.frame, 0, query, deferred_);
        slot.stack.size = 0;
        slot.next = root_.root;
    }

    void finish() {
        while (active_ > 0) turn();
    }

private:
    // With four, second bounces on 2 M triangles went at 2.5 instead of 2.9 million a second (docs/tried.md).
    static constexpr std::size_t kSlots = 8;
    using One = Traversal<kMeshes, Query>;
    struct Slot {
        std::optional<RayFrame> frame;
        BoxRay box;
        alignas(64) std::byte storage[sizeof(One)];
        One* traversal;
        Stack::Rows rows;
        Stack stack{rows};
        flat::Child next;
    };

    HWY_INLINE void turn() {
        for (std::size_t i = 0; i < active_;) {
            Slot& slot = slots_[order_[i]];
            if (slot.traversal->advance(slot.stack, slot.next))
                ++i;
            else
                std::swap(order_[i], order_[--active_]);
        }
    }

    const flat::Scene& scene_;
    const flat::Blas& root_;
    DeferredHits* const deferred_;
    std::size_t active_ = 0;
    std::array<std::uint8_t, kSlots> order_ = [] {
        std::array<std::uint8_t, kSlots> all{};
        for (std::size_t i = 0; i < kSlots; ++i) all[i] = static_cast<std::uint8_t>(i);
        return all;
    }();
    std::array<Slot, kSlots> slots_;
};

// Up to kPacket rays. Returns those, by bit, that may still meet what is not listed.
template <class Query>
std::uint32_t search_list(const flat::Scene& scene, const Ray* rays, std::size_t count, Query* queries,
                          DeferredHits* deferred) {
    ListPacket<Query> packet(scene, rays, count, queries);
    const std::uint32_t rest = packet.run();
    if constexpr (Query::kNearest) packet.defer_candidates(*deferred);
    return rest;
}

// False if the rays cannot be traced as a packet.
template <class Query>
bool search_packet(const flat::Scene& scene, const Ray* rays, std::size_t count, Query* queries,
                   DeferredHits* deferred) {
    const flat::Blas& root = flat::blas_at(scene, BlasId::root);
    std::array<BoxRay, kPacket> boxes;
    std::vector<RayFrame> frames;
    frames.reserve(kPacket);
    for (std::size_t i = 0; i < count; ++i) {
        frames.emplace_back(rays[i]);
        set_up(rays[i], frames[i], root, boxes[i]);
        if (!boxes[i].is_taken_as_it_is || boxes[i].octant != boxes[0].octant ||
            longest_axis(boxes[i].direction) != longest_axis(boxes[0].direction))
            return false;
    }
    PacketTraversal<Query>(scene, root, boxes.data(), frames.data(), count, queries, deferred).run();
    return true;
}

template <class Query>
void search_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Query* queries, DeferredHits* deferred) {
    const flat::Blas& root = flat::blas_at(scene, BlasId::root);
    const float spread = packet_spread(scene);
    HWY_ALIGN Interleaved<Query> interleaved(scene, deferred);
    for (std::size_t first = 0; first < count; first += kPacket) {
        const std::size_t some = std::min(kPacket, count - first);
        const std::uint32_t all = (std::uint32_t{1} << some) - 1;
        std::uint32_t active = all;
        if (!scene.list.empty()) active = search_list(scene, rays + first, some, queries + first, deferred);
        if (active == 0) continue;
        with_kinds<false>(scene, [&]<unsigned kKinds>(std::integral_constant<unsigned, kKinds>) HWY_ATTR {
            if constexpr (kKinds == kMeshes)
                if (some > 1 && active == all && are_alike(rays + first, some, spread, root) &&
                    search_packet(scene, rays + first, some, queries + first, deferred))
                    return;
            for (; active != 0; active &= active - 1) {
                const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(active));
                if (kKinds == kMeshes && scene.is_larger_than_cache)
                    interleaved.add(rays[i], queries[i]);
                else
                    search_blas<kKinds>(scene, root, rays[i], RayFrame(rays[i]), 0, queries[i], deferred);
            }
        });
    }
    interleaved.finish();
}

void search_closest_of_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Closest* queries) {
    DeferredHits deferred(queries);
    search_many(scene, rays, count, queries, &deferred);
    deferred.finish(count, [&](std::size_t i) HWY_ATTR {
        *queries[i].best = {}, queries[i].t_max = rays[i].t_max;
        search(scene, BlasId::root, rays[i], RayFrame(rays[i]), 0, queries[i]);
    });
}
void search_any_of_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Any* queries) {
    search_many(scene, rays, count, queries, nullptr);
}

#define LIMN_DEFINE_SEARCH(name, Query)                                                                        \
    void name(const flat::Scene& scene, BlasId id, const Ray& ray, const RayFrame& frame, std::uint64_t first, \
              Query& query) {                                                                                  \
        search(scene, id, ray, frame, first, query);                                                           \
    }
LIMN_FOR_EACH_SEARCH(LIMN_DEFINE_SEARCH)
#undef LIMN_DEFINE_SEARCH

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
