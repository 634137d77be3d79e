#include "trace/traverse.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/traverse.cpp"
#include <hwy/foreach_target.h>

#include <array>

#include "geometry/bvh/slab.h"
#include "trace/searches-inl.h"

#if HWY_TARGETS & ~LIMN_SEARCH_TARGETS
#error "Highway builds for an instruction set that lib/trace/CMakeLists.txt does not name"
#endif

#if HWY_ONCE

namespace limn::trace {

namespace {

// Define search(scene, ray, query) and search(scene, id, frame, first, query) for each query.
#define LIMN_EXPORT_SEARCH(name, Query)                                                                           \
    HWY_EXPORT(name);                                                                                             \
    HWY_EXPORT(name##_in);                                                                                        \
    [[maybe_unused]] void search(const flat::Scene& scene, const Ray& ray, Query& query) {                        \
        HWY_DYNAMIC_DISPATCH(name)(scene, ray, query);                                                            \
    }                                                                                                             \
    [[maybe_unused]] void search(const flat::Scene& scene, BlasId id, const RayFrame& frame, std::uint64_t first, \
                                 Query& query) {                                                                  \
        HWY_DYNAMIC_DISPATCH(name##_in)(scene, id, frame, first, query);                                          \
    }
LIMN_FOR_EACH_SEARCH(LIMN_EXPORT_SEARCH)
#undef LIMN_EXPORT_SEARCH
HWY_EXPORT(search_closest_of_many);
HWY_EXPORT(search_any_of_many);

// Calls visit() with the frame of the ray in the space of a medium's boundary, unless the ray is unusable there.
// `frame` is that of the ray inside the first `level` instances that contain the medium.
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

void find_any(const flat::Scene& scene, std::span<const Ray> rays, bool passes_boundaries, std::uint8_t* found) {
    RoomForRays<Any> queries;
    for (std::size_t i = 0; i < rays.size(); ++i) queries.of[i] = {rays[i].t_max, passes_boundaries};
    HWY_DYNAMIC_DISPATCH(search_any_of_many)(scene, rays.data(), rays.size(), queries.of.data());
    for (std::size_t i = 0; i < rays.size(); ++i) found[i] = queries.of[i].found ? 1 : 0;
}

BlasId boundary_of(const flat::Scene& scene, const flat::Medium& medium) {
    return scene.medium_shapes[medium.shape].boundary;
}

template <class Query>
void search_boundary(const flat::Scene& scene, const flat::Medium& medium, const Ray& ray, Query& query) {
    inside_medium(scene, medium, RayFrame(ray), [&](const RayFrame& frame) {
        search(scene, boundary_of(scene, medium), frame, medium.first_number, query);
    });
}

// Searches the scene, then all boundaries of media. Those that are appended to `out` are flagged.
template <class Query>
void search_all(const flat::Scene& scene, const Ray& ray, Query& query, std::vector<Crossing>* out) {
    search(scene, ray, query);
    const std::size_t before = out != nullptr ? out->size() : 0;
    for (const flat::Medium& medium : scene.media) {
        if (query.ended()) return;
        search_boundary(scene, medium, ray, query);
    }
    for (std::size_t i = before; out != nullptr && i < out->size(); ++i) (*out)[i].index_matched = true;
}

bool meets_bounds(const flat::Medium& medium, const Ray& ray) {
    double near = 0;
    return accel::SlabRay(ray, accel::finite_extent(medium.bounds)).meets(medium.bounds, ray.t_max, near);
}

}  // namespace

Hit closest_hit(const flat::Scene& scene, const Ray& ray) {
    Hit best;
    Closest query{ray.t_max, &best};
    search(scene, ray, query);
    return best;
}

bool any_hit(const flat::Scene& scene, const Ray& ray) {
    Any query{ray.t_max};
    search(scene, ray, query);
    return query.found;
}

void closest_hits(const flat::Scene& scene, std::span<const Ray> rays, Hit* hits) {
    RoomForRays<Closest> queries;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        hits[i] = {};
        queries.of[i] = {rays[i].t_max, &hits[i]};
    }
    HWY_DYNAMIC_DISPATCH(search_closest_of_many)(scene, rays.data(), rays.size(), queries.of.data());
}

void any_hits(const flat::Scene& scene, std::span<const Ray> rays, std::uint8_t* found) {
    find_any(scene, rays, false, found);
}

void are_occluded(const flat::Scene& scene, std::span<const Ray> rays, std::uint8_t* found) {
    find_any(scene, rays, true, found);
}

Hit closest_boundary(const flat::Scene& scene, const flat::Medium& medium, const Ray& ray) {
    Hit hit;
    if (!meets_bounds(medium, ray)) return hit;
    inside_medium(scene, medium, RayFrame(ray), [&](const RayFrame& frame) {
        Closest query{frame.ray.t_max, &hit};
        search(scene, boundary_of(scene, medium), frame, medium.first_number, query);
    });
    return hit;
}

void media_met(const flat::Scene& scene, const Ray& ray, std::vector<std::uint32_t>& media) {
    media.clear();
    const accel::SlabRay slabs(ray, scene.media_extent);
    double near = 0;
    for (std::uint32_t i = 0; i < scene.media.size(); ++i)
        if (slabs.meets(scene.media[i].bounds, ray.t_max, near)) media.push_back(i);
}

void crossings(const flat::Scene& scene, const flat::Medium& medium, const Ray& ray, std::vector<Crossing>& out) {
    out.clear();
    Passages query{{}, ray.t_max, &out};
    search_boundary(scene, medium, ray, query);
}

void every_hit(const flat::Scene& scene, const Ray& ray, std::vector<Crossing>& out,
               const std::optional<Filter>& filter) {
    if (filter) {
        Filtered<Every> query{{ray.t_max, out}, &*filter};
        return search_all(scene, ray, query, &out);
    }
    Every query{ray.t_max, out};
    search_all(scene, ray, query, &out);
}

PassageCount passages(const flat::Scene& scene, const Ray& ray, bool wants_touched, std::vector<Crossing>* out,
                      const std::optional<Filter>& filter) {
    if (filter) {
        Filtered<Passages> query{{{}, ray.t_max, out, wants_touched}, &*filter};
        search_all(scene, ray, query, out);
        return query;
    }
    Passages query{{}, ray.t_max, out, wants_touched};
    search_all(scene, ray, query, out);
    return query;
}

Hit closest_hit(const flat::Scene& scene, const Ray& ray, const Filter& filter) {
    Hit best;
    Filtered<Closest> query{{ray.t_max, &best}, &filter};
    search_all(scene, ray, query, nullptr);
    if (!scene.media.empty() && best.primitive != flat::RawHit::kMiss)
        best.index_matched = best.index_matched || flat::locate(scene, best.primitive).index_matched;
    return best;
}

bool any_hit(const flat::Scene& scene, const Ray& ray, const Filter& filter) {
    Filtered<Any> query{{ray.t_max}, &filter};
    search_all(scene, ray, query, nullptr);
    return query.found;
}

}  // namespace limn::trace

#endif
