#include "limn/shape/mesh.h"

#include "catch.h"
#include "limn/core/error.h"
#include "limn/material/lambertian.h"
#include "limn/shape/hittable_list.h"
#include "limn/shape/triangle.h"
#include "support/meshes.h"
#include "support/random_geometry.h"
#include "support/truth.h"

using namespace limn;
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

TEST_CASE("Mesh: a cube's edges, corners and face planes give t = 1 in all 96 symmetric copies", "[shape][mesh]") {
    const MeshData cube = test::cube_mesh();
    const struct {
        Point3 origin;
        Vec3 direction;
    } rays[] = {
        {{-1, 0, 0}, {1, 0, 0}}, {{-1, -1, -1}, {1, 1, 1}}, {{-1, 0.5, 0}, {1, 0, 0}}, {{-1, -1, 0}, {1, 1, 0}}};
    const std::size_t permutations[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    int hits = 0, copies = 0;
    for (const auto& ray : rays) {
        for (const auto& p : permutations) {
            for (int mirror = 0; mirror < 8; ++mirror) {
                Ray copy;
                for (std::size_t a = 0; a < 3; ++a) {
                    const bool turn = (mirror >> a) & 1;
                    copy.origin[p[a]] = turn ? 1 - ray.origin[a] : ray.origin[a];
                    copy.direction[p[a]] = turn ? -ray.direction[a] : ray.direction[a];  // 0 becomes -0
                }
                const auto hit = Mesh(cube, none()).hit(copy);
                hits += hit && hit->t == 1;
                ++copies;
            }
        }
    }
    CHECK(copies == 192);
    CHECK(hits == copies);
}

TEST_CASE("Mesh: no ray from inside a closed mesh escapes through a vertex or an edge", "[shape][mesh]") {
    Random random(51);
    for (const double shift : {0.0, 1e3, 1e5}) {
        const MeshData data = test::icosphere(2, 1, {shift, 0, 0});
        const Mesh mesh(data, none());
        Tally tally;
        for (int i = 0; i < 10000; ++i) {
            const Point3 origin = Point3{shift, 0, 0} + 0.5 * random.unit();
            const Index3 t = data.triangles[random.index(data.triangles.size())];
            const Point3 a = test::vertex(data, t.a), b = test::vertex(data, t.b);
            const Ray ray{.origin = origin, .direction = a + (i % 2 ? random.uniform() : 0) * (b - a) - origin};
            const auto hit = mesh.hit(ray);
            if (!hit || std::abs(hit->t - 1) > 0.1) tally.fault(ray, "leak");
        }
        INFO("shift " << shift << ": " << tally.first);
        CHECK(tally.wrong == 0);
    }
}

TEST_CASE("Mesh: barycentrics point at where the ray is, to 4 float ulps of the largest coordinate", "[shape][mesh]") {
    Random random(52);
    for (const double shift : {0.0, 1e3, 1e5}) {
        const MeshData data = test::icosphere(2, 1, {shift, shift, 0});
        const Mesh mesh(data, none());
        Tally tally;
        for (int i = 0; i < 10000; ++i) {
            const Point3 origin = Point3{shift, shift, 0} + random.uniform(1, 20) * random.unit();
            const Ray ray{.origin = origin, .direction = Point3{shift, shift, 0} + 0.9 * random.unit() - origin};
            const auto hit = mesh.hit(ray);
            if (!hit) continue;
            ++tally.hits;
            const Index3 t = data.triangles[hit->element];
            const Point3 a = test::vertex(data, t.a), b = test::vertex(data, t.b), c = test::vertex(data, t.c);
            const Point3 p = a + hit->u * (b - a) + hit->v * (c - a);
            const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
            if (hit->u < 0 || hit->v < 0 || hit->u + hit->v > 1 || length(p - ray.at(hit->t)) > 4 * 0x1p-23 * largest)
                tally.fault(ray, "u, v");
        }
        INFO("shift " << shift << ": " << tally.first);
        CHECK(tally.wrong == 0);
        CHECK(tally.hits > 5000);
    }
}

TEST_CASE("Mesh: no triangle is too small or too large for float32", "[shape][mesh]") {
    for (int k = -20; k <= 18; ++k) {
        const auto s = static_cast<float>(std::pow(10.0, k));
        MeshData data = one_triangle();
        data.vertices = {{0, 0, 0}, {s, 0, 0}, {0, s, 0}};
        const Mesh mesh(data, none());
        CHECK(mesh.degenerate_triangles() == 0);
        const double d = static_cast<double>(s);
        const auto hit = mesh.hit({.origin = {d / 3, d / 3, -10 * d}, .direction = {0, 0, 1}});
        INFO("size 1e" << k);
        REQUIRE(hit);
        CHECK(std::abs(hit->t - 10 * d) <= 0x1p-23 * 10 * d);
    }
    MeshData subnormal = one_triangle();
    subnormal.vertices = {{0, 0, 0}, {1e-45f, 0, 0}, {0, 1e-45f, 0}};
    CHECK(Mesh(subnormal, none()).degenerate_triangles() == 0);
    MeshData huge = one_triangle();
    huge.vertices = {{-3e38f, 0, 0}, {3e38f, 0, 0}, {0, 3e38f, 0}};
    CHECK(Mesh(huge, none()).hit({.origin = {0, 1e38, 1}, .direction = {0, 0, -1}}));
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

TEST_CASE("Mesh: a collinear triangle misses: pbrt's bad case", "[shape][mesh]") {
    MeshData data = one_triangle();
    data.vertices = {{-1113.45459f, -79.049614f, -56.2431908f},
                     {-1113.45459f, -87.0922699f, -56.2431908f},
                     {-1113.45459f, -79.2090149f, -56.2431908f},
                     {0, 0, 0},
                     {1, 0, 0},
                     {0, 1, 0}};
    data.triangles = {{0, 1, 2}, {3, 4, 5}};
    const Mesh mesh(data, none());
    CHECK(mesh.degenerate_triangles() == 1);
    const Ray ray{.origin = {-1081.47925, 99.9999542, 87.7701111},
                  .direction = {-32.1072998, -183.355865, -144.607635}};
    CHECK_FALSE(mesh.hit(ray));
}

TEST_CASE("Mesh: the reported t of a skinny triangle lies within its vertices' distances", "[shape][mesh]") {
    // Embree issue 387: edges 11.2, 9.7, 1.4, half a degree off its plane.
    Random random(53);
    Tally tally;
    for (int i = 0; i < 10000; ++i) {
        const Vec3 x = random.unit(), y = normalize(cross(x, random.unit())), n = cross(x, y);
        const Vec3 base = random.in_cube(20);
        MeshData data = one_triangle();
        data.vertices = {test::to_float3(base), test::to_float3(base + 11.2 * x),
                         test::to_float3(base + 9.64 * x + 0.9 * y)};
        const Mesh mesh(data, none());
        const double around = random.uniform(0, 2 * kPi), off = radians(0.52);
        const Vec3 d = std::cos(off) * (std::cos(around) * x + std::sin(around) * y) - std::sin(off) * n;
        const Point3 aim = Point3{} + base + random.uniform(0, 0.9) * (11.2 * x) + random.uniform(0, 0.4) * y;
        const Ray ray{.origin = aim - random.uniform(1, 600) * d, .direction = d};
        const auto hit = mesh.hit(ray);
        const Point3 a = test::vertex(data, 0), b = test::vertex(data, 1), c = test::vertex(data, 2);
        judge(tally, ray, test::true_triangle_hit(a, b, c, ray), hit);
        if (!hit) continue;
        double nearest = kInfinity, farthest = -kInfinity;
        for (const Point3& p : {a, b, c}) {
            nearest = std::min(nearest, dot(p - ray.origin, d));
            farthest = std::max(farthest, dot(p - ray.origin, d));
        }
        const double slack = 4 * 0x1p-23 * farthest;
        if (hit->t < nearest - slack || hit->t > farthest + slack) tally.fault(ray, "t outside the triangle");
    }
    INFO(tally.first);
    CHECK(tally.wrong == 0);
    CHECK(tally.hits > 500);
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
