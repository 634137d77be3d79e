// Closed meshes, and rays that are hard on queries that count.
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "limn/math/math.h"
#include "limn/math/ray.h"
#include "support/meshes.h"
#include "support/random_geometry.h"

namespace limn::test {

/// A sphere cut from an icosahedron in `rounds` rounds, each of which halves about half of the edges: triangles of all
/// shapes, closed, without T-junctions; its vertices are moved in and out by up to `bumps` of the radius.
inline MeshData bumpy_sphere(Random& random, int rounds, double bumps, double radius, const Point3& center) {
    const MeshData start = icosphere(0);
    std::vector<Vec3> points;
    for (const Float3& p : start.vertices) points.push_back(normalize(Vec3{p.x, p.y, p.z}));
    std::vector<Index3> faces = start.triangles;
    for (; rounds > 0; --rounds) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::optional<std::uint32_t>> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [place, is_new] = middles.try_emplace(std::minmax(a, b));
            if (is_new && random.chance(0.5)) {
                place->second = static_cast<std::uint32_t>(points.size());
                const double s = random.uniform(0.2, 0.8);
                points.push_back(normalize(s * points[a] + (1 - s) * points[b]));
            }
            return place->second;
        };
        std::vector<Index3> finer;
        for (Index3 f : faces) {
            auto ab = middle(f.a, f.b), bc = middle(f.b, f.c), ca = middle(f.c, f.a);
            const auto turn = [&] {
                f = {f.b, f.c, f.a};
                const auto first = ab;
                ab = bc, bc = ca, ca = first;
            };
            const int cuts = ab.has_value() + bc.has_value() + ca.has_value();
            if (cuts == 0) finer.push_back(f);
            if (cuts == 1) {
                while (!ab) turn();
                finer.insert(finer.end(), {{f.a, *ab, f.c}, {*ab, f.b, f.c}});
            }
            if (cuts == 2) {
                while (ca) turn();
                finer.insert(finer.end(), {{*ab, f.b, *bc}, {f.a, *ab, *bc}, {f.a, *bc, f.c}});
            }
            if (cuts == 3)
                finer.insert(finer.end(), {{f.a, *ab, *ca}, {f.b, *bc, *ab}, {f.c, *ca, *bc}, {*ab, *bc, *ca}});
        }
        faces = std::move(finer);
    }
    MeshData mesh;
    for (const Vec3& p : points)
        mesh.vertices.push_back(to_float3((center - Point3{}) + radius * (1 + bumps * random.uniform(-1, 1)) * p));
    mesh.triangles = std::move(faces);
    return mesh;
}

/// Two cones back to back over a ring of `count` points: fans of `count` triangles at both tips.
inline MeshData double_cone(std::uint32_t count, double radius, const Point3& center) {
    MeshData mesh;
    for (const double z : {radius, -radius}) mesh.vertices.push_back(to_float3((center - Point3{}) + Vec3{0, 0, z}));
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 2 * kPi * i / count;
        const std::uint32_t here = 2 + i, next = 2 + (i + 1) % count;
        mesh.vertices.push_back(to_float3((center - Point3{}) + radius * Vec3{std::cos(angle), std::sin(angle), 0}));
        mesh.triangles.push_back({0, here, next});
        mesh.triangles.push_back({1, next, here});
    }
    return mesh;
}

struct QueryMesh {
    std::string name;
    MeshData data;
};

/// One mesh of several.
inline MeshData together(const std::vector<MeshData>& parts) {
    MeshData all;
    for (const MeshData& part : parts) {
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
        all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
        for (const Index3& t : part.triangles) all.triangles.push_back({first + t.a, first + t.b, first + t.c});
    }
    return all;
}

/// With its normals the other way.
inline MeshData inverted(MeshData mesh) {
    for (Index3& t : mesh.triangles) std::swap(t.b, t.c);
    return mesh;
}

/// Closed ones: round, with rays in the planes of faces, with fans and slivers, and shells that are nested, inverted
/// and touch each other in faces, edges and vertices.
inline std::vector<QueryMesh> query_meshes(Random& random) {
    const MeshData cube = cube_mesh();
    return {{"icosphere", icosphere(3)},
            {"cube", cube},
            {"U", u_shape()},
            {"bumpy", bumpy_sphere(random, 6, 0.3, 1, {0, 0, 0})},
            {"double cone", double_cone(60, 1, {0, 0, 0})},
            {"far away", icosphere(2, 1, {1e5, 1e5, 0})},
            {"nested", together({cube_mesh(4, {-1, -1, -1}), inverted(cube_mesh(2, {0, 0, 0})), cube_mesh(1, {0, 0, 0}),
                                 icosphere(1, 0.25, {0.5, 0.5, 0.5})})},
            {"touching", together({cube, cube_mesh(1, {1, 0, 0}), cube_mesh(1, {1, 1, 0}), cube_mesh(1, {2, 2, 1}),
                                   cube, inverted(cube_mesh(1, {0, 0, 1}))})}};
}

/// A point of a triangle: inside, on an edge or a vertex, rounded.
inline Point3 point_of(Random& random, const MeshData& data, std::size_t kind) {
    const Index3 t = data.triangles[random.index(data.triangles.size())];
    const Point3 a = vertex(data, t.a), b = vertex(data, t.b), c = vertex(data, t.c);
    if (kind == 0) return a;
    const double u = random.chance(0.3) ? 0.5 : random.uniform();
    if (kind == 1) return a + u * (b - a);
    const double v = random.uniform(0, 1 - u);
    return a + u * (b - a) + v * (c - a);
}

/// Where query_ray's rays go: at vertices, edges or faces, in the planes of faces and along edges, parallel to the
/// axes, anywhere.
enum class Aim : std::uint8_t { vertex, edge, face, plane, axis, anywhere };

/// From anywhere, from points of the surface too.
inline Ray query_ray(Random& random, const MeshData& data, std::optional<Aim> aim = {}) {
    Box box;
    for (std::uint32_t i = 0; i < data.vertices.size(); ++i) box.extend(vertex(data, i));
    const Point3 middle = box.lower + 0.5 * box.diagonal();
    const double size = length(box.diagonal());
    Ray ray;
    ray.origin = middle + random.uniform(0, 2) * size * random.unit();
    if (random.chance(0.3)) ray.origin = point_of(random, data, random.index(3));
    if (random.chance(0.1)) ray.origin = random.in_box(box);
    if (!aim) aim = static_cast<Aim>(random.index(6));
    if (*aim <= Aim::face) {
        ray.direction = point_of(random, data, static_cast<std::size_t>(*aim)) - ray.origin;
    } else if (*aim == Aim::plane) {  // in the plane of a face, or along an edge, if rounding leaves it there
        const Index3 t = data.triangles[random.index(data.triangles.size())];
        const Point3 a = vertex(data, t.a);
        const Vec3 u = vertex(data, t.b) - a, v = vertex(data, t.c) - a;
        const double s = static_cast<double>(random.index(3)) - 1, r = static_cast<double>(random.index(3)) - 1;
        ray.direction = s * u + r * v;
        ray.origin = a + static_cast<double>(random.index(5)) * 0.5 * v - 3 * ray.direction;
    } else if (*aim == Aim::axis) {
        ray.direction[random.index(3)] = random.sign();
        const Point3 p = point_of(random, data, random.index(3));
        for (std::size_t k = 0; k < 3; ++k) ray.origin[k] = p[k] - 2 * size * ray.direction[k];
    } else {
        ray.direction = random.unit();
    }
    if (ray.direction == Vec3{}) ray.direction = {0, 0, 1};
    const double reach = size / max_abs(ray.direction);
    switch (random.index(8)) {
        case 0: ray.t_min = -kInfinity; break;
        case 1: ray.t_max = random.uniform(0, 3) * reach; break;
        case 2: ray.t_max = 1; break;
        case 3: ray.t_min = -random.uniform(0, 2) * reach; break;
        default: break;
    }
    return ray;
}

}  // namespace limn::test
