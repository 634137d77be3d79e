// One triangle of an indexed mesh, for described and compiled scenes.
#pragma once

#include "geometry/filter.h"
#include "geometry/plane_normal.h"
#include "limn/math/box.h"
#include "limn/math/mesh_view.h"

namespace limn {

inline Point3 to_point(const Float3& p) { return {p.x, p.y, p.z}; }
inline Vec3 to_vec(const Float3& v) { return {v.x, v.y, v.z}; }

struct TriangleVertices {
    Point3 a, b, c;
};

inline TriangleVertices triangle_vertices(const MeshView& mesh, std::size_t i) {
    const Index3 t = mesh.triangles[i];
    return {to_point(mesh.vertices[t.a]), to_point(mesh.vertices[t.b]), to_point(mesh.vertices[t.c])};
}

// Returns true if the triangle has exactly no area.
inline bool is_degenerate(const TriangleVertices& v) { return are_collinear(v.a, v.b, v.c); }

inline Box triangle_bounds(const TriangleVertices& v) {
    Box box;
    for (const Point3& p : {v.a, v.b, v.c}) box.extend(p);
    return box;
}

// Returns the interpolated unit shading normal, on the side of the mesh's own normals. Returns `flat` if the mesh has
// no normals or if they cancel.
inline Normal3 shading_normal(const MeshView& mesh, std::size_t i, const PlanarHit& hit, const Normal3& flat) {
    if (mesh.normals.empty()) return flat;
    const Index3 t = mesh.triangles[i];
    const Vec3 n = (1 - hit.u - hit.v) * normalize(to_vec(mesh.normals[t.a])) +
                   hit.u * normalize(to_vec(mesh.normals[t.b])) + hit.v * normalize(to_vec(mesh.normals[t.c]));
    const Vec3 unit = normalize(n);
    return is_finite(unit) ? Normal3(unit) : flat;
}

// Returns the interpolated texture coordinates, or the hit's u and v if the mesh has none.
inline Uv texture_coordinates(const MeshView& mesh, std::size_t i, const PlanarHit& hit) {
    if (mesh.uvs.empty()) return {hit.u, hit.v};
    const Index3 t = mesh.triangles[i];
    const Float2 a = mesh.uvs[t.a], b = mesh.uvs[t.b], c = mesh.uvs[t.c];
    const double w = 1 - hit.u - hit.v;
    return {w * a.u + hit.u * b.u + hit.v * c.u, w * a.v + hit.u * b.v + hit.v * c.v};
}

}  // namespace limn
