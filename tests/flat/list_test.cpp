// Scenes of few primitives, which are listed: what stands in the list, and that all are asked as through a tree.
#include "catch.h"
#include "flat/scene.h"
#include "limn/query/compiled_scene.h"
#include "support/scene_zoo.h"
#include "support/tally.h"

namespace limn::list_test {

using namespace test;

namespace {

Object square(double height) {
    return std::make_shared<Quad>(Point3{-1, height, -1}, Vec3{2, 0, 0}, Vec3{0, 0, 2}, nullptr);
}

Object triangle(double height) {
    return std::make_shared<Triangle>(Point3{-1, height, -1}, Point3{1, height, -1}, Point3{-1, height, 1}, nullptr);
}

// Rooms as people build them: walls, boxes that are turned and placed, balls, a small mesh.
ZooScene room(std::uint64_t seed) {
    Random random(seed);
    const double size = random.log_uniform(1e-3, 1e4);
    std::vector<Object> objects{make_box(Point3{-size, -size, -size}, Point3{size, size, size}, nullptr)};
    for (int i = 0; i < 3; ++i) {
        const double edge = size * random.uniform(0.1, 0.5);
        const Transform pose = Transform::translate(random.in_cube(0.7 * size)) *
                               Transform::rotate(random.unit(), random.uniform(0, 360)) *
                               Transform::scale(edge, edge * random.uniform(0.3, 3), -edge);
        objects.push_back(std::make_shared<Instance>(make_box({0, 0, 0}, {1, 1, 1}, nullptr), pose));
        objects.push_back(ball(Point3{} + random.in_cube(0.7 * size), size * random.uniform(0.05, 0.4)));
    }
    objects.push_back(objects[2]);  // twice in the same place
    objects.push_back(std::make_shared<Mesh>(cube_mesh(0.2 * size, {0, 0, 0}), nullptr));
    const Point3 p = Point3{} + random.in_cube(0.5 * size);
    objects.push_back(std::make_shared<Triangle>(p, p + size * random.unit(), p + size * random.unit(), nullptr));
    return zoo_of("room " + std::to_string(seed), objects);
}

// Rays at random, and of each that hits one that leaves the surface, one that enters it and one along it.
std::vector<Ray> rays_in(const ZooScene& zoo, const CompiledScene& compiled, Random& random, int count) {
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        rays.push_back(random_ray(random, zoo.targets));
        const auto hit = compiled.closest_hit(rays.back());
        if (!hit) continue;
        const Surface s = compiled.surface_at(rays.back(), *hit);
        const Vec3 out = random.unit(), normal(s.normal);
        rays.push_back(s.spawn_ray(out, 0));
        rays.push_back(s.spawn_ray(-out, 0));
        rays.push_back(s.spawn_ray(out - dot(out, normal) * normal + random.uniform(-1e-7, 1e-7) * normal, 0));
        if (i % 3 == 0) rays.back().t_max = random.uniform(0, 3);
        if (i % 5 == 0) rays.back().t_min = random.uniform(-2, 0);
        if (i % 7 == 0) rays.back().direction = random.log_uniform(1e-6, 1e6) * rays.back().direction;
    }
    return rays;
}

// Such a room with more in it than can be listed: a fine mesh, and by turns many small shapes, moving and user-defined
// ones.
ZooScene furnished(std::uint64_t seed) {
    ZooScene zoo = room(seed);
    Random random(50 + seed);
    const Box bounds = zoo.scene.objects()[0]->bounds();
    const double size = bounds.upper.x;
    const auto somewhere = [&] { return Point3{} + random.in_cube(0.7 * size); };
    std::vector<Object> objects(zoo.scene.objects().begin(), zoo.scene.objects().end());
    objects.insert(objects.begin() + 2,
                   std::make_shared<Mesh>(icosphere(3, 0.2 * size, random.in_cube(0.7 * size)), nullptr));
    for (int i = 0; i < 70 && seed % 2 == 0; ++i) {
        const Point3 p = somewhere();
        const double edge = 0.02 * size;
        objects.push_back(std::make_shared<Quad>(p, edge * random.unit(), edge * random.unit(), nullptr));
    }
    if (seed % 3 == 0) objects.push_back(std::make_shared<Stranger>(ball(somewhere(), 0.2 * size)));
    if (seed % 3 == 1) objects.push_back(std::make_shared<Sphere>(somewhere(), somewhere(), 0.1 * size, nullptr));
    return zoo_of("furnished " + std::to_string(seed), objects);
}

void check_answers(const ZooScene& zoo, const CompiledScene& compiled, std::uint64_t seed) {
    Random random(700 + seed);
    const std::vector<Ray> rays = rays_in(zoo, compiled, random, 700);
    std::vector<RayHit> hits(rays.size());
    std::vector<std::uint8_t> occluded(rays.size());
    compiled.closest_hit(rays, hits);
    compiled.any_hit(rays, occluded);
    Tally tally;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray& ray = rays[i];
        ++tally.rays;
        double t = kInfinity;
        std::uint32_t object = 0;
        Ray rest = ray;
        for (std::uint32_t k = 0; k < zoo.scene.objects().size(); ++k) {
            const auto hit = zoo.scene.objects()[k]->hit(rest);
            if (hit && hit->t < t) t = rest.t_max = hit->t, object = k;
        }
        const RayHit single = compiled.closest_hit(ray).value_or(RayHit{});
        tally.hits += t < kInfinity;
        if (single.t != t || single.object != object) tally.fault(ray, "single");
        if (hits[i].t != t || hits[i].object != object || hits[i].primitive != single.primitive ||
            hits[i].u != single.u || hits[i].v != single.v)
            tally.fault(ray, "batch");
        if (compiled.any_hit(ray) != (t < kInfinity)) tally.fault(ray, "any");
        if ((occluded[i] != 0) != (t < kInfinity)) tally.fault(ray, "any, batch");
    }
    INFO(zoo.name << ": " << tally.first);
    CHECK(tally.wrong == 0);
    CHECK(tally.hits > tally.rays / 3);
    CHECK(tally.hits < tally.rays);
}

}  // namespace

TEST_CASE("Lists: rooms are answered as their described objects are, single rays and batches alike",
          "[compile][list]") {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const ZooScene zoo = room(seed);
        const CompiledScene compiled = compile(zoo.scene);
        REQUIRE(compiled.flat().list.is_all);
        check_answers(zoo, compiled, seed);
    }
}

TEST_CASE("Lists: so are rooms with a list of what is large and a tree of the rest", "[compile][list]") {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const ZooScene zoo = furnished(seed);
        const CompiledScene compiled = compile(zoo.scene);
        const flat::PrimitiveList& list = compiled.flat().list;
        REQUIRE_FALSE(list.is_all);
        REQUIRE(list.quads >= 6);
        check_answers(zoo, compiled, seed);
    }
}

TEST_CASE("Lists: rays that end about the side of the box of the rest stop where those of the described objects do",
          "[compile][list]") {
    // A lamp that hangs flat under a ceiling, turned any way.
    for (std::size_t axis = 0; axis < 6; ++axis) {
        Random random(90 + axis);
        MeshData data;
        const auto turned = [&](double x, double y, double z) {
            Vec3 p{x, axis < 3 ? y : -y, z};
            for (std::size_t i = 0; i < axis % 3; ++i) p = {p.z, p.x, p.y};
            return p;
        };
        constexpr std::uint32_t kSide = 9;
        for (std::uint32_t j = 0; j <= kSide; ++j)
            for (std::uint32_t i = 0; i <= kSide; ++i) {
                const Vec3 p = turned(213 + 13 * i, 554, 227 + 11 * j);
                data.vertices.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
            }
        for (std::uint32_t j = 0; j < kSide; ++j)
            for (std::uint32_t i = 0; i < kSide; ++i) {
                const std::uint32_t a = j * (kSide + 1) + i, c = a + kSide + 1;
                data.triangles.push_back({a, a + 1, c + 1});
                data.triangles.push_back({a, c + 1, c});
            }
        const auto wall = [&](const Point3& corner, const Vec3& u, const Vec3& v) {
            return std::make_shared<Quad>(Point3{} + turned(corner.x, corner.y, corner.z), turned(u.x, u.y, u.z),
                                          turned(v.x, v.y, v.z), nullptr);
        };
        const Object lamp = std::make_shared<Mesh>(data, nullptr);
        const ZooScene zoo = zoo_of(
            "lamp", {wall({0, 0, 0}, {555, 0, 0}, {0, 0, 555}), wall({0, 555, 0}, {555, 0, 0}, {0, 0, 555}), lamp});
        const CompiledScene compiled = compile(zoo.scene);
        REQUIRE((compiled.flat().kinds & ~flat::kPlanarKinds) == 0);
        REQUIRE(compiled.flat().list.quads == 2);
        std::vector<Ray> rays;
        for (int i = 0; i < 4000; ++i) {
            const double off = random.chance(0.3) ? 0 : random.sign() * random.log_uniform(1e-14, 1e-7);
            const Vec3 to = turned(random.uniform(200, 350), 554 + off, random.uniform(215, 340));
            const Vec3 from = turned(random.uniform(1, 554), random.uniform(random.chance(0.5) ? 553 : 1, 554.9),
                                     random.uniform(1, 554));
            const double t_max = random.chance(0.2) ? 1.0 : 1 + random.sign() * random.log_uniform(1e-16, 1e-6);
            rays.push_back({.origin = Point3{} + from, .direction = to - from, .t_min = 0, .t_max = t_max});
        }
        std::vector<std::uint8_t> stopped(rays.size());
        compiled.any_hit(rays, stopped);
        int at_lamp = 0, wrong = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const bool met = lamp->hit(rays[i]).has_value();
            at_lamp += met, wrong += met != (stopped[i] != 0);
        }
        CHECK(wrong == 0);
        CHECK(at_lamp > 500);
        CHECK(at_lamp < 3500);
    }
}

TEST_CASE("Lists: what a ray meets beside other shapes is met however far away it is", "[compile][list]") {
    Scene scene;
    scene.add(std::make_shared<Floor>());
    scene.add(ball({0, 5, 0}, 1));
    const CompiledScene compiled = compile(scene);
    for (const double t : {0x1p10, 0x1p100, 0x1p150, 0x1p300}) {
        const std::vector<Ray> rays(3, Ray{.origin = {0, 1, 0}, .direction = {1, -1 / t, 0}});
        std::vector<RayHit> hits(rays.size());
        compiled.closest_hit(rays, hits);
        for (const RayHit& hit : hits) CHECK(hit.t == t);
        const std::optional<RayHit> alone = compiled.closest_hit(rays[0]);
        REQUIRE(alone);
        CHECK(alone->t == t);
        CHECK(compiled.any_hit(rays[0]));
    }
}

TEST_CASE("Lists: quads come first, then triangles, then spheres, each with its number", "[compile][list]") {
    Scene scene;
    scene.add(ball({0, 0, 0}, 1));
    scene.add(triangle(1));
    scene.add(std::make_shared<Mesh>(cube_mesh(1, {0, 0, 0}), nullptr));
    scene.add(square(2));
    const CompiledScene compiled = compile(scene);
    const flat::PrimitiveList& list = compiled.flat().list;
    REQUIRE(list.entries.size() == 15);
    CHECK(list.quads == 1);
    CHECK(list.triangles == 13);
    CHECK(list.spheres == 1);
    CHECK(list.entries.front().kind == PrimitiveKind::quad);
    CHECK(list.entries.front().number == 14);
    CHECK(list.entries[1].number == 1);
    CHECK(list.entries[2].number == 2);
    CHECK(list.entries.back().kind == PrimitiveKind::sphere);
    CHECK(list.entries.back().number == 0);
}

TEST_CASE("Lists: planes and weights of edges are those of the primitive, to float", "[compile][list]") {
    Random random(31);
    Scene scene;
    for (int i = 0; i < 40; ++i) scene.add(random_shape(random, i % 2 ? 2 : 3));
    const CompiledScene compiled = compile(scene);
    const flat::PrimitiveList& list = compiled.flat().list;
    REQUIRE(list.entries.size() == 40);
    for (std::uint32_t i = 0; i < list.planars(); ++i) {
        const flat::PrimitiveList::Entry& e = list.entries[i];
        const auto row = [&](std::size_t r) { return double{list.planar[r * list.planar_stride + i]}; };
        const auto along = [&](std::size_t r, const Point3& p) {
            return row(r) * p.x + row(r + 1) * p.y + row(r + 2) * p.z;
        };
        using List = flat::PrimitiveList;
        const double slack = 1e-6 * (row(List::kSpread) * 20 + 1);
        for (const auto& [u, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.25, 0.5}}) {
            const Point3 p = e.corner + u * e.edge_u + v * e.edge_v;
            CHECK(std::abs(along(List::kNormal, p) - row(List::kOffset)) < 1e-5);
            CHECK(std::abs(along(List::kU, p) - row(List::kUOffset) - u) < slack);
            CHECK(std::abs(along(List::kV, p) - row(List::kVOffset) - v) < slack);
        }
    }
}

TEST_CASE(
    "Lists: scenes that are large, moving, thin, nested, user-defined or of extreme size are not listed as a whole",
    "[compile][list]") {
    const auto is_listed = [](const std::vector<Object>& objects) {
        return compile(zoo_of("", objects).scene).flat().list.is_all;
    };
    std::vector<Object> most(flat::PrimitiveList::kMost, ball({1, 2, 3}, 1));
    CHECK(is_listed(most));
    most.push_back(square(0));
    CHECK_FALSE(is_listed(most));
    CHECK_FALSE(is_listed({}));

    const Object still = std::make_shared<Instance>(square(0), Transform::rotate_y(30));
    CHECK(is_listed({square(1), still}));
    CHECK_FALSE(is_listed({square(1), std::make_shared<Instance>(still, Transform::rotate_y(30))}));
    CHECK_FALSE(is_listed({square(1), std::make_shared<Instance>(square(0), Transform{}, Transform::rotate_y(30))}));
    CHECK_FALSE(is_listed({square(1), std::make_shared<Instance>(ball({0, 0, 0}, 1), Transform::rotate_y(30))}));
    CHECK_FALSE(is_listed({square(1), std::make_shared<Sphere>(Point3{}, Point3{1, 0, 0}, 1.0, nullptr)}));
    CHECK_FALSE(is_listed({square(1), std::make_shared<Stranger>(square(0))}));
    CHECK_FALSE(is_listed({square(1), std::make_shared<Quad>(Point3{}, Vec3{1, 0, 0}, Vec3{1, 1e-5, 0}, nullptr)}));
    CHECK_FALSE(is_listed({square(1), ball({0, 0, 0}, 1e-5)}));
    CHECK_FALSE(is_listed({square(1), ball({1e15, 0, 0}, 1e13)}));
}

TEST_CASE("Lists: a triangle without area is in none, its number stays its own", "[compile][list]") {
    MeshData data;
    data.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
    data.triangles = {{0, 1, 3}, {0, 1, 2}};
    Scene scene;
    scene.add(std::make_shared<Mesh>(data, nullptr));
    const CompiledScene compiled = compile(scene);
    REQUIRE(compiled.flat().list.entries.size() == 1);
    const auto hit = compiled.closest_hit({.origin = {0.25, 0.25, 1}, .direction = {0, 0, -1}});
    REQUIRE(hit);
    CHECK(hit->element == 1);
}

}  // namespace limn::list_test
