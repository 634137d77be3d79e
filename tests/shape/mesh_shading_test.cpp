// What a mesh interpolates over its triangles, and how exactly each shape knows its hits.
#include "catch.h"
#include "limn/scene/shape/mesh.h"
#include "limn/scene/shape/quad.h"
#include "limn/scene/shape/sphere.h"
#include "limn/scene/shape/triangle.h"

namespace limn::mesh_shading_test {

namespace {

MeshData right_triangle() {
    MeshData data;
    data.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    data.triangles = {{0, 1, 2}};
    return data;
}

// At the weights 1/4, 1/4, 1/2 of its vertices.
Hit hit_inside(const MeshData& data) {
    const auto hit = Mesh(data, nullptr).hit({.origin = {1, 2, 3}, .direction = {0, 0, -1}});
    REQUIRE(hit);
    CHECK((hit->u == 0.25 && hit->v == 0.5));
    return *hit;
}

double error_of(const Hittable& shape, const Ray& ray) {
    const auto hit = shape.hit(ray);
    REQUIRE(hit);
    CHECK((hit->position_error.x == hit->position_error.y && hit->position_error.y == hit->position_error.z));
    return hit->position_error.x;
}

}  // namespace

TEST_CASE("Mesh: normals are interpolated as directions, whatever their lengths, and made unit", "[shape][mesh]") {
    MeshData data = right_triangle();
    data.normals = {{2, 0, 0}, {0, 3, 0}, {0, 0, 0.5F}};
    const Hit hit = hit_inside(data);
    CHECK(length(Vec3(hit.shading_normal) - normalize(Vec3{0.25, 0.25, 0.5})) <= 1e-15);
    CHECK(hit.normal == Normal3{0, 0, 1});
}

TEST_CASE("Mesh: where the normals cancel, or there are none, the shading is flat", "[shape][mesh]") {
    MeshData data = right_triangle();
    CHECK(hit_inside(data).shading_normal == Normal3{0, 0, 1});
    data.normals = {{1, 0, 0}, {1, 0, 0}, {-1, 0, 0}};  // 1/4 + 1/4 - 1/2
    CHECK(hit_inside(data).shading_normal == Normal3{0, 0, 1});
}

TEST_CASE("Mesh: texture coordinates are weighted as the vertices are, and without any they are u and v",
          "[shape][mesh]") {
    MeshData data = right_triangle();
    CHECK(*hit_inside(data).uv == Uv{0.25, 0.5});
    data.uvs = {{4, 400}, {8, 800}, {16, 1600}};
    CHECK(*hit_inside(data).uv == Uv{1 + 2 + 8, 100 + 200 + 800});
}

TEST_CASE("Shapes: the error bound of a hit grows with each coordinate that goes into it", "[shape][error]") {
    const Ray down{.origin = {0, 0, 4096}, .direction = {0, 0, -1}};
    const auto in_units = [](double error) { return error / gamma(64); };
    CHECK(in_units(error_of(Sphere({0, 0, 0}, 8, nullptr), down)) == Approx(8));
    CHECK(in_units(error_of(Sphere({0, 0, 0}, -8, nullptr), down)) == Approx(8));
    CHECK(in_units(error_of(Sphere({0, 0, -64}, 8, nullptr), down)) == Approx(72));
    CHECK(in_units(error_of(Quad({-1, -1, -64}, {2, 0, 0}, {0, 2, 0}, nullptr), down)) == Approx(68));
    CHECK(in_units(error_of(Quad({-1, -1, 0}, {32, 0, 0}, {0, 16, 0}, nullptr), down)) == Approx(49));
    CHECK(in_units(error_of(Triangle({-1, -1, -64}, {31, -1, -64}, {-1, 15, -64}, nullptr), down)) == Approx(112));
    MeshData data;
    data.vertices = {{-1, -1, -64}, {31, -1, -64}, {-1, 15, -64}};
    data.triangles = {{0, 1, 2}};
    CHECK(in_units(error_of(Mesh(data, nullptr), down)) == Approx(112));
}

}  // namespace limn::mesh_shading_test
