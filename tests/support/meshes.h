// Closed meshes made of few numbers.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "limn/math/vec.h"
#include "limn/scene/shape/mesh.h"

namespace limn::test {

inline Float3 to_float3(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline Point3 vertex(const MeshData& mesh, std::uint32_t i) {
    return {mesh.vertices[i].x, mesh.vertices[i].y, mesh.vertices[i].z};
}

/// An icosahedron whose faces are cut in four `level` times and pushed out onto the sphere, normals outward.
inline MeshData icosphere(int level, double radius = 1, const Vec3& center = {}) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    std::vector<Vec3> points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (Vec3& p : points) p = normalize(p);
    std::vector<Index3> faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (; level > 0; --level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [place, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
            if (is_new) points.push_back(normalize(points[a] + points[b]));
            return place->second;
        };
        std::vector<Index3> finer;
        for (const Index3& f : faces) {
            const std::uint32_t ab = middle(f.a, f.b), bc = middle(f.b, f.c), ca = middle(f.c, f.a);
            finer.insert(finer.end(), {{f.a, ab, ca}, {f.b, bc, ab}, {f.c, ca, bc}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    MeshData mesh;
    for (const Vec3& p : points) mesh.vertices.push_back(to_float3(center + radius * p));
    mesh.triangles = faces;
    return mesh;
}

/// The cube [0, side]^3 + corner as 12 triangles, normals outward.
inline MeshData cube_mesh(double side = 1, const Vec3& corner = {}) {
    MeshData mesh;
    for (int i = 0; i < 8; ++i)
        mesh.vertices.push_back(to_float3(corner + side * Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1)));
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

/// The boundary of a solid U: an extruded concave polygon, 3 wide, 2 high, 1 deep, with a slot of 1 x 1.
inline MeshData u_shape() {
    const double outline[8][2] = {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    const Index3 front[6] = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {0, 4, 5}, {0, 5, 7}, {5, 6, 7}};  // counter-clockwise
    MeshData mesh;
    for (const double z : {1.0, 0.0})
        for (const auto& p : outline) mesh.vertices.push_back(to_float3({p[0], p[1], z}));
    for (const Index3& f : front) {
        mesh.triangles.push_back(f);
        mesh.triangles.push_back({f.a + 8, f.c + 8, f.b + 8});
    }
    for (std::uint32_t i = 0; i < 8; ++i) {
        const std::uint32_t j = (i + 1) % 8;
        mesh.triangles.push_back({i, i + 8, j});
        mesh.triangles.push_back({j, i + 8, j + 8});
    }
    return mesh;
}

}  // namespace limn::test
