#include "limn/scene/shape/mesh_edges.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "catch.h"
#include "support/meshes.h"

namespace limn::mesh_edges_test {

using namespace test;

namespace {

EdgeCounts count(MeshData data) { return count_edges(Mesh(std::move(data), nullptr)); }

void check(const MeshData& data, std::size_t edges, std::size_t open, std::size_t nonmanifold) {
    const EdgeCounts counts = count(data);
    CHECK(counts.edges == edges);
    CHECK(counts.open == open);
    CHECK(counts.nonmanifold == nonmanifold);
    CHECK(counts.is_closed() == (open == 0));
}

MeshData joined(MeshData a, const MeshData& b) {
    const auto offset = static_cast<std::uint32_t>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const Index3& t : b.triangles) a.triangles.push_back({t.a + offset, t.b + offset, t.c + offset});
    return a;
}

// The same triangles, each with three vertices of its own.
MeshData split(const MeshData& data) {
    MeshData result;
    for (const Index3& t : data.triangles) {
        const auto first = static_cast<std::uint32_t>(result.vertices.size());
        for (const std::uint32_t i : {t.a, t.b, t.c}) result.vertices.push_back(data.vertices[i]);
        result.triangles.push_back({first, first + 1, first + 2});
    }
    return result;
}

}  // namespace

TEST_CASE("Edges: closed meshes have three edges to two triangles, and none is open", "[shape][mesh]") {
    check(cube_mesh(), 18, 0, 0);
    check(u_shape(), 42, 0, 0);
    check(icosphere(2), 480, 0, 0);
}

TEST_CASE("Edges: a cube without a face is open around it, without two triangles that touch at a corner around both",
          "[shape][mesh]") {
    MeshData box = cube_mesh();
    box.triangles.erase(box.triangles.begin(), box.triangles.begin() + 2);
    check(box, 17, 4, 0);
    MeshData torn = cube_mesh();
    torn.triangles = {{0, 2, 1}, {5, 7, 6}};
    check(torn, 6, 6, 0);
    check(MeshData{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                   .triangles = {{0, 1, 2}},
                   .normals = {},
                   .uvs = {},
                   .material_slots = {},
                   .faces = {}},
          3, 3, 0);
}

TEST_CASE("Edges: two cubes that touch along an edge share one of four triangles and stay closed", "[shape][mesh]") {
    check(joined(cube_mesh(), cube_mesh(1, {1, 1, 0})), 35, 0, 1);
    check(joined(cube_mesh(), cube_mesh(1, {1, 1, 1})), 36, 0, 0);  // at a corner
    check(joined(cube_mesh(), cube_mesh(1, {2, 0, 0})), 36, 0, 0);  // not at all
}

TEST_CASE("Edges: a triangle on an edge of a closed mesh makes it one of three, and opens its own two",
          "[shape][mesh]") {
    MeshData finned = cube_mesh();
    finned.vertices.push_back({-1, -1, 0.5F});
    finned.triangles.push_back({0, 4, 8});
    check(finned, 20, 2, 1);
}

TEST_CASE("Edges: triangles that lie twice count twice", "[shape][mesh]") {
    MeshData twice = cube_mesh();
    twice.triangles.push_back(twice.triangles[0]);
    check(twice, 18, 0, 3);
}

TEST_CASE("Edges: vertices at the same position are one, whatever their numbers and the sign of a zero",
          "[shape][mesh]") {
    check(split(cube_mesh()), 18, 0, 0);
    check(split(icosphere(2)), 480, 0, 0);
    MeshData signs = split(cube_mesh());
    for (std::size_t i = 0; i < signs.vertices.size(); i += 2)
        for (float* v : {&signs.vertices[i].x, &signs.vertices[i].y, &signs.vertices[i].z})
            if (*v == 0) *v = -0.0F;
    check(signs, 18, 0, 0);
    MeshData apart = split(cube_mesh());
    apart.vertices[0].x = 0x1p-149F;  // the smallest step off
    CHECK(count(apart).open > 0);
}

TEST_CASE("Edges: triangles without an area are left out", "[shape][mesh]") {
    MeshData box = cube_mesh();
    box.vertices.push_back({0.5F, 0, 0});  // on the edge from 0 to 1
    for (const Index3 flat : {Index3{0, 8, 1}, {0, 0, 5}, {3, 3, 3}}) box.triangles.push_back(flat);
    check(box, 18, 0, 0);
}

TEST_CASE("Edges: their number depends neither on the order nor on the sense of triangles", "[shape][mesh]") {
    MeshData sphere = split(icosphere(2));
    sphere.triangles.resize(200);
    const EdgeCounts before = count(sphere);
    REQUIRE(before.open > 0);
    std::mt19937 generator(3);
    for (int round = 0; round < 3; ++round) {
        std::shuffle(sphere.triangles.begin(), sphere.triangles.end(), generator);
        for (Index3& t : sphere.triangles)
            if (generator() % 2 == 0) t = {t.c, t.b, t.a};
        check(sphere, before.edges, before.open, before.nonmanifold);
    }
}

}  // namespace limn::mesh_edges_test
