// Normals by a crease angle.
#include "limn/scene/shape/smooth_normals.h"

#include "catch.h"
#include "geometry/mesh_triangle.h"
#include "limn/math/error.h"
#include "support/meshes.h"

namespace limn::smooth_normals_test {

using namespace test;

TEST_CASE("Smooth normals: those of a sphere point away from its centre, and no vertex is split", "[shape][smooth]") {
    const MeshData sphere = icosphere(3), smooth = smooth_normals(sphere, 30);
    REQUIRE(smooth.vertices.size() == sphere.vertices.size());
    for (std::size_t i = 0; i < smooth.vertices.size(); ++i)
        CHECK(length(to_vec(smooth.normals[i]) - to_vec(smooth.vertices[i])) < 0.01);
}

TEST_CASE("Smooth normals: a cube keeps its edges below 90 degrees and loses them above", "[shape][smooth]") {
    const MeshData sharp = smooth_normals(cube_mesh(), 89), round = smooth_normals(cube_mesh(), 91);
    CHECK(sharp.vertices.size() == 24);
    for (const Index3& t : sharp.triangles) {
        CHECK(sharp.normals[t.a] == sharp.normals[t.b]);
        CHECK(sharp.normals[t.a] == sharp.normals[t.c]);
    }
    REQUIRE(round.vertices.size() == 8);
    // Three sides of the same angle, however many triangles they are.
    for (std::size_t i = 0; i < 8; ++i) {
        const Vec3 outward = normalize(to_vec(round.vertices[i]) - Vec3{0.5, 0.5, 0.5});
        CHECK(length(to_vec(round.normals[i]) - outward) < 1e-6);
    }
}

TEST_CASE("Smooth normals: vertices at one position are one, texture coordinates stay apart", "[shape][smooth]") {
    MeshData roof;
    roof.vertices = {{0, 0, 0}, {0, 1, 0}, {-1, 0, -0.1f}, {0, 0, 0}, {0, 1, 0}, {1, 0, -0.1f}};
    roof.triangles = {{0, 1, 2}, {4, 3, 5}};
    roof.uvs = {{0, 0}, {0, 1}, {1, 0}, {0.5f, 0}, {0.5f, 1}, {1, 1}};
    roof.faces = {7, 9};
    const MeshData smooth = smooth_normals(roof, 30);
    CHECK(smooth.vertices.size() == 6);
    CHECK(smooth.faces == roof.faces);
    const Index3 left = smooth.triangles[0], right = smooth.triangles[1];
    CHECK(smooth.normals[left.a] == smooth.normals[right.b]);
    CHECK(smooth.normals[left.b] == smooth.normals[right.a]);
    CHECK(smooth.uvs[left.a] == Float2{0, 0});
    CHECK(smooth.uvs[right.b] == Float2{0.5f, 0});
    CHECK(std::abs(smooth.normals[left.a].x) < 1e-6f);
    CHECK(smooth_normals(roof, 5).normals[0].x != 0);
}

TEST_CASE("Smooth normals: triangles without area, three at an edge and opposite sides do no harm", "[shape][smooth]") {
    MeshData mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {2, 0, 0}, {9, 9, 9}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {0, 1, 5}, {0, 2, 1}};
    const MeshData smooth = smooth_normals(mesh, 180);
    CHECK_NOTHROW(Mesh(smooth, nullptr));
    CHECK(smooth.triangles.size() == 5);
    CHECK(smooth.material_slots.empty());
}

TEST_CASE("Smooth normals: angles and indices out of range, and arrays of other lengths, are refused",
          "[shape][smooth]") {
    for (const double angle : {-1.0, 181.0, std::nan("")})
        CHECK_THROWS_AS(smooth_normals(cube_mesh(), angle), ArgumentError);
    MeshData broken = cube_mesh();
    broken.triangles.push_back({0, 1, 8});
    CHECK_THROWS_AS(smooth_normals(broken, 30), ArgumentError);
    for (const std::size_t more : {std::size_t{0}, std::size_t{2}}) {  // one too few, one too many
        MeshData uvs = cube_mesh(), slots = cube_mesh(), faces = cube_mesh();
        uvs.uvs.resize(uvs.vertices.size() - 1 + more);
        slots.material_slots.resize(slots.triangles.size() - 1 + more);
        faces.faces.resize(faces.triangles.size() - 1 + more);
        for (const MeshData& data : {uvs, slots, faces}) CHECK_THROWS_AS(smooth_normals(data, 30), ArgumentError);
    }
}

}  // namespace limn::smooth_normals_test
