#include "kernels/traverse.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/traverse.cpp"
#include <hwy/foreach_target.h>

#include "accel/slab.h"
#include "kernels/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

template <class... Kinds>
constexpr unsigned kinds(Kinds... kind) {
    return (flat::bit(kind) | ...);
}

// The sets of kinds that have code of their own. Simple scenes do not pay for what only others need.
constexpr unsigned kMeshes = kinds(PrimitiveKind::mesh);
constexpr unsigned kSpheres = kinds(PrimitiveKind::sphere, PrimitiveKind::moving_sphere) & flat::kBuiltKinds;
constexpr unsigned kStill =
    kinds(PrimitiveKind::sphere, PrimitiveKind::triangle, PrimitiveKind::quad, PrimitiveKind::mesh);
constexpr unsigned kAll = flat::kBuiltKinds;

template <class Query>
void search(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame, std::uint64_t first_number,
            Query& query) {
    const flat::Group& group = flat::group_at(scene, id);
    const auto run = [&]<unsigned kKinds>(std::integral_constant<unsigned, kKinds>) HWY_ATTR {
        const BoxRay box = box_ray(ray, frame, group);
        Traversal<kKinds, Query>(scene, group, box, frame, first_number, query).run();
    };
    const auto covers = [&](unsigned set) { return (scene.kinds & ~set) == 0; };
    if (covers(kMeshes)) return run(std::integral_constant<unsigned, kMeshes>{});
    if (covers(kSpheres)) return run(std::integral_constant<unsigned, kSpheres>{});
    if (covers(kStill)) return run(std::integral_constant<unsigned, kStill>{});
    run(std::integral_constant<unsigned, kAll>{});
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

Hit nearest(const flat::Scene& scene, GroupId id, const Ray& ray, const RayFrame& frame, std::uint64_t first_number) {
    Closest query{{frame.ray.t_max, flat::RawHit::kMiss}};
    HWY_DYNAMIC_DISPATCH(search_closest)(scene, id, ray, frame, first_number, query);
    return query.best.primitive == flat::RawHit::kMiss ? Hit{} : Hit{query.best, query.u, query.v};
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
