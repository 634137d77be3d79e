// The exact question to a primitive of a list.
#pragma once

#include "flat/scene.h"
#include "kernels/exact_tests.h"
#include "kernels/traverse.h"

namespace limn::kernels {

// Of a triangle, in a mesh or not.
inline TriangleVertices triangle_listed(const flat::Scene& scene, const flat::PrimitiveList::Entry& e) {
    if (e.kind == PrimitiveKind::mesh) return flat::triangle_of(scene, scene.meshes[e.row], e.element);
    const flat::Triangle& t = scene.triangles[e.row];
    return {t.a, t.b, t.c};
}

// Asks one primitive and reports a hit to the query; false if it is missed.
template <class Query>
bool ask_listed(const flat::Scene& scene, const flat::PrimitiveList::Entry& e, const RayFrame& frame, Query& query) {
    const Search search{frame.ray.t_min, query.limit()};
    ExactTests exact(frame, kInfinity);
    PlanarHit hit{};
    bool found = false;
    switch (e.kind) {
        case PrimitiveKind::quad: {
            const flat::Quad& q = scene.quads[e.row];
            found = exact.quad(q.corner, q.edge_u, q.edge_v, search, hit);
            break;
        }
        case PrimitiveKind::triangle:
        case PrimitiveKind::mesh: {
            const TriangleVertices t = triangle_listed(scene, e);
            found = exact.triangle(t.a, t.b, t.c, search, hit);
            break;
        }
        case PrimitiveKind::sphere: {
            const flat::Sphere& s = scene.spheres[e.row];
            found = exact.sphere(s.center, std::abs(s.radius), search, hit.t);
            break;
        }
        default: break;
    }
    if (found) query.report(hit, e.number, false);
    return found;
}

// The same for a ray of the world.
template <class Query>
bool ask_listed(const flat::Scene& scene, const flat::PrimitiveList::Entry& e, const Ray& ray, Query& query) {
    const RayFrame frame(ray);
    if (!e.is_instanced) return ask_listed(scene, e, frame, query);
    return inside(scene.instances[e.instance], frame,
                  [&](const RayFrame& inner) { return is_usable(inner.ray) && ask_listed(scene, e, inner, query); });
}

// Each in turn, until the query has its answer: for rays that float cannot hold. Whether it has.
template <class Query>
bool ask_all_listed(const flat::Scene& scene, const Ray& ray, Query& query) {
    for (const flat::PrimitiveList::Entry& e : scene.list.entries) {
        ask_listed(scene, e, ray, query);
        if (query.ended()) return true;
    }
    return false;
}

}  // namespace limn::kernels
