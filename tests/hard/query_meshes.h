// Meshes and the rays that are hard on queries that count.
#pragma once

#include <string>
#include <vector>

#include "hard/exact_mesh.h"
#include "limn/shape/constant_medium.h"
#include "limn/shape/disk.h"

namespace limn::test {

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

inline CompiledScene compiled_mesh(const MeshData& data) {
    Scene scene;
    scene.add(std::make_shared<Mesh>(data, nullptr));
    return compile(scene);
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

/// At vertices, edges or faces, along edges, in the planes of faces, parallel to the axes, or anyhow; from anywhere,
/// from points of the surface too.
inline Ray query_ray(Random& random, const MeshData& data) {
    Box box;
    for (std::uint32_t i = 0; i < data.vertices.size(); ++i) box.extend(vertex(data, i));
    const Point3 middle = box.lower + 0.5 * box.diagonal();
    const double size = length(box.diagonal());
    Ray ray;
    ray.origin = middle + random.uniform(0, 2) * size * random.unit();
    if (random.chance(0.3)) ray.origin = point_of(random, data, random.index(3));
    if (random.chance(0.1)) ray.origin = random.in_box(box);
    const std::size_t kind = random.index(6);
    if (kind < 3) {
        ray.direction = point_of(random, data, kind) - ray.origin;
    } else if (kind == 3) {  // in the plane of a face, or along an edge, if rounding leaves it there
        const Index3 t = data.triangles[random.index(data.triangles.size())];
        const Point3 a = vertex(data, t.a);
        const Vec3 u = vertex(data, t.b) - a, v = vertex(data, t.c) - a;
        const double s = static_cast<double>(random.index(3)) - 1, r = static_cast<double>(random.index(3)) - 1;
        ray.direction = s * u + r * v;
        ray.origin = a + static_cast<double>(random.index(5)) * 0.5 * v - 3 * ray.direction;
    } else if (kind == 4) {
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

inline bool same(const RayHit& a, const RayHit& b) {
    return a.t == b.t && a.object == b.object && a.element == b.element && a.u == b.u && a.v == b.v &&
           a.index_matched == b.index_matched && a.primitive == b.primitive;
}

/// Media, spheres, disks, instances, meshes and a ground that stands beside the tree.
inline ZooScene zoo_to_filter(Random& random) {
    std::vector<Object> objects{std::make_shared<Mesh>(icosphere(2), nullptr),
                                std::make_shared<Mesh>(u_shape(), nullptr),
                                make_box({-1, -1, -1}, {1, 1, 1}, nullptr),
                                ball({1, 0, 0}, 1),
                                ball({0, 1, 0}, -1),
                                std::make_shared<Disk>(Point3{0, 0, 0}, Vec3{1, 1, 1}, 2, nullptr),
                                std::make_shared<ConstantMedium>(ball({0, 0, 1}, 1), 1, Color{1, 1, 1}),
                                ball({0, -1e3, 0}, 998),
                                std::make_shared<Stranger>(ball({0, 0, 0}, 1.5))};
    for (int i = 0; i < 60; ++i) objects.push_back(random_instance(random, random_shape(random, random.index(5), 2)));
    return zoo_of("to filter", objects);
}

}  // namespace limn::test
