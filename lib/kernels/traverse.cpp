#include "kernels/traverse.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/traverse.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <array>

#include "accel/slab.h"
#include "kernels/packet-inl.h"
#include "kernels/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

template <class... Kinds>
constexpr unsigned kinds(Kinds... kind) {
    return (flat::bit(kind) | ...);
}

// The sets of kinds that have code of their own. Simple scenes do not pay for what only others need.
constexpr unsigned kMeshes = kinds(PrimitiveKind::mesh);
constexpr unsigned kMeshesAndAsked =
    kinds(PrimitiveKind::mesh, PrimitiveKind::instance, PrimitiveKind::foreign) & flat::kBuiltKinds;
constexpr unsigned kSpheres = kinds(PrimitiveKind::sphere, PrimitiveKind::moving_sphere) & flat::kBuiltKinds;
constexpr unsigned kFlat = kinds(PrimitiveKind::triangle, PrimitiveKind::quad, PrimitiveKind::mesh);
constexpr unsigned kStill =
    kinds(PrimitiveKind::sphere, PrimitiveKind::triangle, PrimitiveKind::quad, PrimitiveKind::mesh);
constexpr unsigned kAll = flat::kBuiltKinds;

template <class Query>
void search(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame, std::uint64_t first_number,
            Query& query) {
    const flat::Group& group = flat::group_at(scene, id);
    const auto run = [&]<unsigned kKinds>(std::integral_constant<unsigned, kKinds>) HWY_ATTR {
        BoxRay box;
        set_up(ray, frame, group, box);
        Traversal<kKinds, Query>(scene, group, box, frame, first_number, query).run();
    };
    const auto covers = [&](unsigned set) { return (scene.kinds & ~set) == 0; };
    if (covers(kMeshes)) return run(std::integral_constant<unsigned, kMeshes>{});
    if (covers(kMeshesAndAsked)) return run(std::integral_constant<unsigned, kMeshesAndAsked>{});
    if (covers(kFlat)) return run(std::integral_constant<unsigned, kFlat>{});
    if (covers(kSpheres)) return run(std::integral_constant<unsigned, kSpheres>{});
    if (covers(kStill)) return run(std::integral_constant<unsigned, kStill>{});
    run(std::integral_constant<unsigned, kAll>{});
}

constexpr float kPacketTriangles = 4;

// How far rays may part, in their directions and of the extent, to be traced together: over more triangles than there
// are lanes a packet does more work than its rays one by one.
float packet_spread(const flat::Scene& scene) {
    const auto across = std::sqrt(static_cast<float>(scene.stored_primitives));  // triangles from side to side
    return std::min(1 / 16.0f, kPacketTriangles / across);
}

// Whether the rays go much the same way, so that they meet much the same boxes.
bool are_alike(const BoxRay* rays, std::size_t count, float spread) {
    const BoxRay& first = rays[0];
    const unsigned axis = longest_axis(first.direction);
    for (std::size_t i = 0; i < count; ++i) {
        const BoxRay& ray = rays[i];
        if (!ray.is_taken_as_it_is || ray.octant != first.octant || longest_axis(ray.direction) != axis) return false;
        for (std::size_t a = 0; a < 3; ++a) {
            const float turn = ray.direction[a] * ray.inverse[axis] - first.direction[a] * first.inverse[axis];
            if (!(std::abs(turn) < spread && std::abs(ray.high[a] - first.high[a]) < spread * first.extent))
                return false;
        }
    }
    return true;
}

template <class Query>
void search_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Query* queries) {
    const flat::Group& root = flat::group_at(scene, GroupId::root);
    if (scene.kinds != kMeshes) {
        for (std::size_t i = 0; i < count; ++i) search(scene, GroupId::root, rays[i], RayFrame(rays[i]), 0, queries[i]);
        return;
    }
    std::array<BoxRay, kPacket> boxes;
    const float spread = packet_spread(scene);
    std::vector<RayFrame> frames;
    frames.reserve(kPacket);
    for (std::size_t first = 0; first < count; first += kPacket) {
        const std::size_t some = std::min(kPacket, count - first);
        frames.clear();
        for (std::size_t i = 0; i < some; ++i) {
            frames.emplace_back(rays[first + i]);
            set_up(rays[first + i], frames[i], root, boxes[i]);
        }
        if (some > 1 && are_alike(boxes.data(), some, spread)) {
            PacketTraversal<Query>(scene, root, boxes.data(), frames.data(), some, queries + first).run();
        } else {
            for (std::size_t i = 0; i < some; ++i)
                Traversal<kMeshes, Query>(scene, root, boxes[i], frames[i], 0, queries[first + i]).run();
        }
    }
}

void search_closest_of_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Closest* queries) {
    search_many(scene, rays, count, queries);
}
void search_any_of_many(const flat::Scene& scene, const Ray* rays, std::size_t count, Any<false>* queries) {
    search_many(scene, rays, count, queries);
}

void search_closest(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame, std::uint64_t first,
                    Closest& query) {
    search(scene, id, ray, frame, first, query);
}
void search_any(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame, std::uint64_t first,
                Any<false>& query) {
    search(scene, id, ray, frame, first, query);
}
void search_occluder(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame, std::uint64_t first,
                     Any<true>& query) {
    search(scene, id, ray, frame, first, query);
}
void search_every(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame, std::uint64_t first,
                  Every& query) {
    search(scene, id, ray, frame, first, query);
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace limn::kernels {

namespace {

HWY_EXPORT(search_closest);
HWY_EXPORT(search_any);
HWY_EXPORT(search_occluder);
HWY_EXPORT(search_every);
HWY_EXPORT(search_closest_of_many);
HWY_EXPORT(search_any_of_many);

Hit nearest(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame, std::uint64_t first_number) {
    Closest query{{{frame.ray.t_max, flat::RawHit::kMiss}}};
    HWY_DYNAMIC_DISPATCH(search_closest)(scene, id, ray, frame, first_number, query);
    return query.hit();
}

// visit(frame) with the ray as a medium's boundary sees it, `level` instances below the scene, unless nothing can be
// hit.
template <class Visit>
void inside_medium(const flat::Scene& scene, const flat::Medium& medium, const RayFrame& frame, const Visit& visit,
                   std::uint32_t level = 0) {
    if (level < medium.instance_count) {
        const std::uint32_t instance = scene.medium_instances[medium.first_instance + level];
        return inside(scene.instances[instance], frame,
                      [&](const RayFrame& inner) { inside_medium(scene, medium, inner, visit, level + 1); });
    }
    if (is_usable(frame.ray)) visit(frame);
}

GroupId boundary_of(const flat::Scene& scene, const flat::Medium& medium) {
    return scene.medium_shapes[medium.shape].boundary;
}

bool meets_bounds(const flat::Medium& medium, const Ray& ray) {
    double near = 0;
    return accel::SlabRay(ray, accel::finite_extent(medium.bounds)).meets(medium.bounds, ray.t_max, near);
}

}  // namespace

Hit closest_hit(const flat::Scene& scene, const Ray& ray) {
    return nearest(scene, GroupId::root, ray, RayFrame(ray), 0);
}

bool any_hit(const flat::Scene& scene, const Ray& ray) {
    Any<false> query{ray.t_max};
    HWY_DYNAMIC_DISPATCH(search_any)(scene, GroupId::root, ray, RayFrame(ray), 0, query);
    return query.found;
}

void closest_hits(const flat::Scene& scene, std::span<const Ray> rays, Hit* hits) {
    std::array<Closest, kMostRays> queries;
    for (std::size_t i = 0; i < rays.size(); ++i) queries[i] = {{{rays[i].t_max, flat::RawHit::kMiss}}};
    HWY_DYNAMIC_DISPATCH(search_closest_of_many)(scene, rays.data(), rays.size(), queries.data());
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = queries[i].hit();
}

void any_hits(const flat::Scene& scene, std::span<const Ray> rays, std::uint8_t* found) {
    std::array<Any<false>, kMostRays> queries;
    for (std::size_t i = 0; i < rays.size(); ++i) queries[i] = {rays[i].t_max};
    HWY_DYNAMIC_DISPATCH(search_any_of_many)(scene, rays.data(), rays.size(), queries.data());
    for (std::size_t i = 0; i < rays.size(); ++i) found[i] = queries[i].found ? 1 : 0;
}

bool is_occluded(const flat::Scene& scene, const Ray& ray) {
    Any<true> query{ray.t_max};
    HWY_DYNAMIC_DISPATCH(search_occluder)(scene, GroupId::root, ray, RayFrame(ray), 0, query);
    return query.found;
}

Hit closest_boundary(const flat::Scene& scene, const flat::Medium& medium, const Ray& ray) {
    Hit hit;
    if (!meets_bounds(medium, ray)) return hit;
    inside_medium(scene, medium, RayFrame(ray), [&](const RayFrame& frame) {
        hit = nearest(scene, boundary_of(scene, medium), frame.ray, frame, medium.first_number);
    });
    return hit;
}

void crossings(const flat::Scene& scene, const flat::Medium& medium, const Ray& ray, std::vector<Crossing>& out) {
    out.clear();
    if (!meets_bounds(medium, ray)) return;
    inside_medium(scene, medium, RayFrame(ray), [&](const RayFrame& frame) {
        Every query{ray.t_max, out};
        HWY_DYNAMIC_DISPATCH(search_every)
        (scene, boundary_of(scene, medium), frame.ray, frame, medium.first_number, query);
    });
}

}  // namespace limn::kernels

#endif
