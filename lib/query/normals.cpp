#include "limn/query/normals.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>

#include "query/batches.h"
#include "query/surface_at.h"

namespace limn {

namespace {

constexpr std::size_t kTogether = 256;  // number of hits whose triangles are prefetched together

// Returns a pointer to the entry of flat::Mesh::places for the triangle of a hit, which says where its vertices are
// packed. Returns null for a miss and for a primitive whose vertices are not packed.
const std::uint32_t* place_of(const flat::Scene& scene, const RayHit& hit) {
    if (hit.t == kInfinity) return nullptr;
    const flat::Place place = flat::locate(scene, hit.primitive);
    const PrimitiveRange& range = scene.ranges[place.range];
    if (range.kind != PrimitiveKind::mesh || scene.meshes[range.first_row].places.empty()) return nullptr;
    return &scene.meshes[range.first_row].places[place.element];
}

// Prefetches the triangles of at most kTogether hits: first their entries of flat::Mesh::places, then their blocks.
// Without the prefetch, each hit of an incoherent ray would wait for memory twice.
void prefetch(const flat::Scene& scene, std::span<const RayHit> hits) {
    std::array<const std::uint32_t*, kTogether> places;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        places[i] = place_of(scene, hits[i]);
        if (places[i] != nullptr) hwy::Prefetch(places[i]);
    }
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (places[i] != nullptr) hwy::Prefetch(&scene.lines[*places[i] / flat::kMaxBlock]);
}

}  // namespace

void outward_normals(const CompiledScene& scene, std::span<const Ray> rays, std::span<const RayHit> hits,
                     std::span<Vec3> normals) {
    query::check_length(rays.size(), hits.size(), "outward_normals", "rays and hits");
    query::check_length(rays.size(), normals.size(), "outward_normals", "rays and normals");
    query::ask(scene, [&](const flat::Scene& tables) {
        query::SurfaceHit found;
        for (std::size_t first = 0; first < rays.size(); first += kTogether) {
            const std::size_t end = std::min(first + kTogether, rays.size());
            prefetch(tables, hits.subspan(first, end - first));
            for (std::size_t i = first; i < end; ++i) {
                const RayHit& hit = hits[i];
                normals[i] = {};
                if (hit.t == kInfinity) continue;
                query::surface_at(tables, rays[i], {{hit.t, hit.primitive}, hit.u, hit.v},
                                  {.uv = false, .tangents = false}, found);
                // The normal of a Surface is on the side of the ray: turn it back to the outward side.
                const Vec3 normal(found.surface.normal);
                normals[i] = found.surface.front_face ? normal : -normal;
            }
        }
    });
}

}  // namespace limn
