#include "limn/scene/shape/mesh.h"

#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/shape/hittable_list.h"
#include "limn/scene/shape/triangle.h"
#include "support/meshes.h"
#include "support/random_geometry.h"
#include "support/tally.h"

namespace limn::mesh_test {

using limn::test::Random;
using limn::test::Tally;

namespace {

std::shared_ptr<const Material> none() { return nullptr; }

MeshData one_triangle() {
    MeshData data;
    data.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    data.triangles = {{0, 1, 2}};
    return data;
}

test::Targets targets_of(const MeshData& data) {
    test::Targets targets{Mesh(data, none()).bounds(), {}};
    for (const Index3& t : data.triangles) {
        const Point3 a = test::vertex(data, t.a), b = test::vertex(data, t.b);
        targets.points.push_back(a);
        targets.points.push_back(a + 0.5 * (b - a));
    }
    return targets;
}

}  // namespace

TEST_CASE("Mesh: the same hits as its triangles one by one, ties to the lowest", "[shape][mesh]") {
    Random random(50);
    for (const MeshData& data :
         {test::icosphere(1), test::cube_mesh(), test::u_shape(), test::icosphere(1, 0.01, {1e3, 0, 5})}) {
        HittableList triangles;
        for (const Index3& t : data.triangles)
            triangles.add(std::make_shared<Triangle>(test::vertex(data, t.a), test::vertex(data, t.b),
                                                     test::vertex(data, t.c), none()));
        const Mesh mesh(data, none());
        const test::Targets targets = targets_of(data);
        Tally tally;
        for (int i = 0; i < 10000; ++i) {
            const Ray ray = random_ray(random, targets);
            const auto a = mesh.hit(ray), b = triangles.hit(ray);
            if (a.has_value() != b.has_value()) {
                tally.fault(ray, "hit and miss");
                continue;
            }
            if (!a) continue;
            ++tally.hits;
            if (a->t != b->t || a->element != b->element || a->u != b->u || a->v != b->v || !(a->normal == b->normal))
                tally.fault(ray, "another hit");
        }
        INFO(tally.first);
        CHECK(tally.wrong == 0);
        CHECK(tally.hits > 2000);
    }
}

TEST_CASE("Mesh: triangles without area are dropped and counted, the others stay where they are", "[shape][mesh]") {
    MeshData data = one_triangle();
    data.vertices.insert(data.vertices.end(), {{1, 1, 1}, {2, 2, 2}, {5, 5, 5}});
    data.triangles = {{1, 1, 2}, {0, 3, 4}, {3, 3, 3}, {0, 1, 2}, {0, 2, 0}};
    const Mesh mesh(data, none());
    CHECK(mesh.degenerate_triangles() == 4);
    CHECK(count_elements(mesh) == 5);
    const auto hit = mesh.hit({.origin = {0.25, 0.25, 1}, .direction = {0, 0, -1}});
    REQUIRE(hit);
    CHECK(hit->element == 3);
    CHECK_FALSE(mesh.hit({.origin = {1.5, 1.5, 3}, .direction = {0, 0, -1}}));
    CHECK_FALSE(mesh.hit({.origin = {-1, 1.5, 1.5}, .direction = {1, 0, 0}}));
    CHECK(mesh.bounds() == Box{{0, 0, 0}, {1, 1, 0}});  // degenerate ones cannot be hit and widen nothing
    data.triangles = {{0, 0, 1}, {0, 3, 4}};
    CHECK_THROWS_AS(Mesh(data, none()), Error);
    data.triangles = {};
    CHECK_THROWS_AS(Mesh(data, none()), Error);
}

TEST_CASE("Mesh: an index, slot, length or value that cannot be right is refused by name", "[shape][mesh]") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto refused = [](const std::function<void(MeshData&)>& spoil, const char* what) {
        MeshData data = one_triangle();
        spoil(data);
        CHECK_THROWS_AS(Mesh(data, none()), ArgumentError);
        CHECK_THROWS_WITH(Mesh(data, none()), Catch::Contains(what));
    };
    refused([](MeshData& d) { d.triangles[0].b = 3; }, "triangle 0");
    refused([](MeshData& d) { d.triangles[0].c = 0xffffffff; }, "vertex");
    refused([&](MeshData& d) { d.vertices[1].y = nan; }, "vertex 1");
    refused([](MeshData& d) { d.vertices[2].z = std::numeric_limits<float>::infinity(); }, "vertex 2");
    refused([](MeshData& d) { d.normals = {{0, 0, 1}}; }, "normals");
    refused([](MeshData& d) { d.normals = {{0, 0, 1}, {0, 0, 0}, {0, 0, 1}}; }, "normal 1");
    refused([](MeshData& d) { d.normals = {{0, 0, 0}, {0, 0, 1}, {0, 0, 1}}; }, "normal 0");
    refused([&](MeshData& d) { d.normals = {{0, 0, 1}, {0, 0, 1}, {nan, 0, 1}}; }, "normal 2");
    refused([](MeshData& d) { d.uvs = {{0, 0}, {1, 0}}; }, "uvs");
    refused([&](MeshData& d) { d.uvs = {{0, 0}, {1, nan}, {0, 1}}; }, "texture coordinate 1");
    refused([&](MeshData& d) { d.uvs = {{nan, 0}, {1, 0}, {0, 1}}; }, "texture coordinate 0");
    refused([&](MeshData& d) { d.vertices[0].x = nan; }, "vertex 0");
    refused([](MeshData& d) { d.triangles.push_back({0, 1, 3}); }, "triangle 1 refers to vertex 3 of 3");
    refused([](MeshData& d) { d.triangles.push_back({3, 1, 2}); }, "triangle 1 refers to vertex 3 of 3");
    refused([](MeshData& d) { d.material_slots = {0, 0}; }, "material_slots");
    refused([](MeshData& d) { d.material_slots = {1}; }, "material");
    refused([](MeshData& d) { d.faces = {0, 0, 0}; }, "faces");
}

TEST_CASE("Mesh: slots choose materials, faces name polygons, vertices give uvs and normals", "[shape][mesh]") {
    MeshData data;
    data.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    data.triangles = {{0, 1, 2}, {0, 2, 3}};
    data.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    data.normals = {{0, 0, 1}, {0.5f, 0, 1}, {0.5f, 0, 1}, {0, 0, 1}};
    data.material_slots = {1, 0};
    data.faces = {7, 7};
    const auto red = std::make_shared<Lambertian>(Color{1, 0, 0}), blue = std::make_shared<Lambertian>(Color{0, 0, 1});
    const Mesh mesh(data, {red, blue});
    const auto lower = mesh.hit({.origin = {1.5, 0.5, 1}, .direction = {0, 0, -1}});
    const auto upper = mesh.hit({.origin = {0.5, 1.5, 1}, .direction = {0, 0, -1}});
    REQUIRE((lower && upper));
    CHECK((lower->element == 0 && upper->element == 1));
    CHECK((lower->material == blue.get() && upper->material == red.get()));
    CHECK((mesh.face(0) == 7 && mesh.face(1) == 7));
    REQUIRE((lower->uv && upper->uv));
    CHECK(lower->uv->u == Approx(0.75));
    CHECK(lower->uv->v == Approx(0.25));
    CHECK(upper->uv->u == Approx(0.25));
    CHECK(upper->uv->v == Approx(0.75));
    CHECK(lower->normal == Normal3{0, 0, 1});
    CHECK(length(Vec3(lower->shading_normal)) == Approx(1));
    CHECK(lower->shading_normal.x > 0.1);
    CHECK(Mesh(one_triangle(), none()).face(0) == 0);
    data.faces.clear();
    CHECK(Mesh(data, {red, blue}).face(1) == 1);
    data.material_slots.clear();
    const Ray down{.origin = {1.5, 0.5, 1}, .direction = {0, 0, -1}};
    CHECK(Mesh(data, {red, blue}).hit(down)->material == red.get());
    CHECK(Mesh(data, std::vector<std::shared_ptr<const Material>>{}).hit(down)->material == nullptr);
}

TEST_CASE("Mesh: an unusable ray misses", "[shape][mesh]") {
    const Mesh mesh(test::icosphere(1), none());
    for (const Ray& ray : test::unusable_rays()) CHECK_FALSE(mesh.hit(ray));
}

TEST_CASE("Mesh: at a vertex the normal and the texture coordinates are that vertex's own", "[shape][mesh]") {
    MeshData data = one_triangle();
    data.normals = {{3, 0, 4}, {0, -3, 4}, {0, 0.6f, 0.8f}};
    data.uvs = {{0.5f, 0.25f}, {2, 3}, {-1, 0}};
    const Mesh mesh(data, none());
    for (const std::uint32_t i : {0u, 1u, 2u}) {
        const auto hit = mesh.hit({.origin = test::vertex(data, i) + Vec3{0, 0, 1}, .direction = {0, 0, -1}});
        REQUIRE(hit);
        const Float3 n = data.normals[i];
        CHECK(length(Vec3(hit->shading_normal) - normalize(Vec3{n.x, n.y, n.z})) <= 1e-15);
        CHECK(hit->uv == Uv{data.uvs[i].u, data.uvs[i].v});
    }
}

}  // namespace limn::mesh_test
