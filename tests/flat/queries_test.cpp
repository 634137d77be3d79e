#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include "catch.h"
#include "limn/math/error.h"
#include "limn/query/compiled_scene.h"
#include "limn/scene/material/diffuse_light.h"
#include "limn/scene/texture/checker.h"
#include "support/same_scene.h"
#include "support/scene_zoo.h"

namespace limn::queries_test {

using namespace test;

namespace {

bool same(const RayHit& a, const RayHit& b) {
    return a.t == b.t && a.object == b.object && a.element == b.element && a.u == b.u && a.v == b.v &&
           a.index_matched == b.index_matched && a.primitive == b.primitive;
}

bool has_feature(const CompiledScene& scene, const std::string& name) {
    return (" " + scene.features() + " ").find(" " + name + " ") != std::string::npos;
}

// Triangles here and there, of edges up to `along` and `aside`.
MeshData scattered(Random& random, std::uint32_t count, double along, double aside) {
    MeshData data;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Point3 a = Point3{} + random.in_cube(1);
        const Vec3 edge = random.in_cube(along), width = random.in_cube(aside);
        for (const Point3& p : {a, a + edge, a + edge + width})
            data.vertices.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
        data.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return data;
}

ZooScene zoo_of_mesh(const char* name, const MeshData& data) {
    return zoo_of(name, {std::make_shared<Mesh>(data, nullptr)});
}

Ray down(double x, double y) { return {.origin = {x, y, 100}, .direction = {0, 0, -1}}; }

}  // namespace

TEST_CASE("CompiledScene: a batch answers as single rays do", "[compile]") {
    for (const ZooScene& zoo : {zoo_mixed(401), zoo_media(), zoo_mesh(), zoo_of_kind("spheres", 0, 40, 200)}) {
        const CompiledScene compiled = compile(zoo.scene);
        Random random(320);
        std::vector<Ray> rays = unusable_rays();
        while (rays.size() < 3001) rays.push_back(random_ray(random, zoo.targets));
        std::vector<RayHit> hits(
            rays.size(),
            RayHit{.t = 1, .object = 7, .element = 7, .u = 7, .v = 7, .index_matched = true, .primitive = 7});
        std::vector<std::uint8_t> occluded(rays.size(), 77);
        CHECK(compiled.closest_hit(rays, hits) == unusable_rays().size());
        CHECK(compiled.any_hit(rays, occluded) == unusable_rays().size());
        int differing = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const auto single = compiled.closest_hit(rays[i]);
            differing += single ? !same(*single, hits[i]) : hits[i].t != kInfinity;
            differing += occluded[i] != (single ? 1 : 0);
        }
        CHECK(differing == 0);
        std::vector<RayHit> few(rays.size() - 1);
        std::vector<std::uint8_t> many(rays.size() + 1);
        CHECK_THROWS_AS(compiled.closest_hit(rays, few), ArgumentError);
        CHECK_THROWS_AS(compiled.any_hit(rays, many), ArgumentError);
        CHECK_NOTHROW(compiled.closest_hit(std::span<const Ray>{}, std::span<RayHit>{}));
    }
}

TEST_CASE("CompiledScene: rays that go much the same way are answered together as they are one by one", "[compile]") {
    Random random(321);
    for (const ZooScene& zoo : {zoo_mesh(), zoo_of_mesh("ball", icosphere(4)),
                                zoo_of_mesh("soup", scattered(random, 3000, 0.2, 0.2)), zoo_mixed(402)}) {
        const CompiledScene compiled = compile(zoo.scene);
        std::vector<Ray> rays;
        for (int bundle = 0; bundle < 400; ++bundle) {
            const Ray first = random_ray(random, zoo.targets);
            const double spread = std::pow(10, random.uniform(-6, -1.5)) * max_abs(first.direction);
            for (int i = 0; i < 37; ++i) {  // more than are ever traced together
                Ray ray = first;
                ray.direction = ray.direction + random.in_cube(spread);
                if (bundle % 3 == 1) ray.origin = ray.origin + random.in_cube(spread);
                if (bundle % 5 == 2) ray.t_max = random.uniform(0, 3);
                if (bundle % 7 == 3) ray.t_min = random.uniform(-1, 2);
                if (i % 11 == 5 && ray.t_min <= ray.t_max) ray.t_min = -ray.t_max;
                rays.push_back(ray);
            }
        }
        std::vector<RayHit> hits(rays.size());
        std::vector<std::uint8_t> occluded(rays.size());
        compiled.closest_hit(rays, hits);
        compiled.any_hit(rays, occluded);
        int differing = 0, found = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const auto single = compiled.closest_hit(rays[i]);
            found += single.has_value();
            differing += single ? !same(*single, hits[i]) : hits[i].t != kInfinity;
            differing += occluded[i] != (single ? 1 : 0);
        }
        INFO(zoo.name);
        CHECK(differing == 0);
        CHECK(found > 1000);
    }
}

TEST_CASE("CompiledScene: of exact duplicates the lowest number is reported", "[compile]") {
    const Object quad = std::make_shared<Quad>(Point3{-1, -1, 0}, Vec3{2, 0, 0}, Vec3{0, 2, 0}, nullptr);
    const Object mesh = std::make_shared<Mesh>(cube_mesh(1, {-0.5, -0.5, -1}), nullptr);  // its top lies in the quad
    const Object fog = std::make_shared<ConstantMedium>(quad, 1, Color{});
    const auto first_of = [](const std::vector<Object>& objects) {
        const auto hit = compile(zoo_of("duplicates", objects).scene)
                             .closest_hit({.origin = {0.1, 0.3, 9}, .direction = {0, 0, -1}});
        REQUIRE(hit);
        CHECK(hit->t == 9);
        return hit->primitive;
    };
    CHECK(first_of({quad, quad, quad}) == 0);
    CHECK(first_of({quad, mesh}) == 0);
    CHECK(first_of({mesh, quad}) < 12);
    CHECK(first_of({fog, quad}) == 0);
    CHECK(first_of({quad, fog}) == 0);
    CHECK(first_of({std::make_shared<Stranger>(quad), quad}) == 0);
    CHECK(first_of({quad, std::make_shared<Stranger>(quad)}) == 0);
    CHECK(first_of({std::make_shared<Instance>(quad, Transform{}), quad, mesh}) == 0);
    std::vector<Object> many(1000, quad);
    CHECK(first_of(many) == 0);
    many.insert(many.begin(), ball({0, 0, -50}, 1));
    CHECK(first_of(many) == 1);
}

TEST_CASE("CompiledScene: object, element and primitive number the scene through", "[compile]") {
    const Object mesh = std::make_shared<Mesh>(cube_mesh(), nullptr);
    const Object list =
        std::make_shared<HittableList>(std::vector<Object>{ball({20, 0, 0}, 1), mesh, ball({30, 0, 0}, 1)});
    const CompiledScene compiled = compile(
        zoo_of("numbers", {ball({10, 0, 0}, 1), list,
                           std::make_shared<Instance>(list, Transform::translate({0, 50, 0})), ball({40, 0, 0}, 1)})
            .scene);
    const auto at = [&](double x, double y) { return *compiled.closest_hit(down(x, y)); };
    CHECK((at(10, 0).object == 0 && at(10, 0).element == 0 && at(10, 0).primitive == 0));
    CHECK((at(20, 0).object == 1 && at(20, 0).element == 0 && at(20, 0).primitive == 1));
    CHECK((at(30, 0).object == 1 && at(30, 0).element == 13 && at(30, 0).primitive == 14));
    CHECK((at(20, 50).object == 2 && at(20, 50).element == 0 && at(20, 50).primitive == 15));
    CHECK((at(30, 50).object == 2 && at(30, 50).element == 13 && at(30, 50).primitive == 28));
    CHECK((at(40, 0).object == 3 && at(40, 0).element == 0 && at(40, 0).primitive == 29));
    CHECK(at(0.25, 0.625).element == 1 + mesh->hit(down(0.25, 0.625))->element);
    CHECK(compiled.stats().primitives == 30);
    CHECK(compiled.stats().stored_primitives == 30);  // nothing is shared
    const Object twin = std::make_shared<Instance>(list, Transform::translate({0, 9, 0}));
    const SceneStats shared =
        compile(zoo_of("shared", {twin, std::make_shared<Instance>(list, Transform{}), ball({}, 1)}).scene).stats();
    CHECK((shared.primitives == 29 && shared.stored_primitives == 15));
}

TEST_CASE("CompiledScene: the range is open at t_min, closed at t_max, for closest_hit and any_hit alike",
          "[compile]") {
    const CompiledScene compiled =
        compile(zoo_of("range", {ball({0, 0, -10}, 2),
                                 std::make_shared<Quad>(Point3{-9, -9, -20}, Vec3{18, 0, 0}, Vec3{0, 18, 0}, nullptr)})
                    .scene);
    const struct {
        double t_min, t_max, expected;
    } cases[] = {{0, kInfinity, 8},
                 {8, kInfinity, 12},
                 {12, kInfinity, 20},
                 {20, kInfinity, kInfinity},
                 {12, 20, 20},
                 {12, std::nextafter(20, 0), kInfinity},
                 {0, 8, 8},
                 {0, std::nextafter(8, 0), kInfinity},
                 {8, 8, kInfinity},
                 {-kInfinity, kInfinity, 8},
                 {std::nextafter(20, 0), kInfinity, 20}};
    for (const auto& c : cases) {
        const Ray ray{{0, 0, 0}, {0, 0, -1}, c.t_min, c.t_max, 0};
        const auto hit = compiled.closest_hit(ray);
        CHECK((hit ? hit->t : kInfinity) == c.expected);
        CHECK(compiled.any_hit(ray) == (c.expected < kInfinity));
    }
}

TEST_CASE("CompiledScene: an unusable ray misses, a far origin does not", "[compile]") {
    for (const ZooScene& zoo : {zoo_mixed(402), zoo_media(), zoo_of("ball", {ball({0, 0, 0}, 1)}), zoo_instances()}) {
        const CompiledScene compiled = compile(zoo.scene);
        for (const Ray& ray : unusable_rays()) {
            CHECK_FALSE(compiled.closest_hit(ray));
            CHECK_FALSE(compiled.any_hit(ray));
        }
    }
    const CompiledScene balls = compile(zoo_of("balls", {ball({0, 0, 0}, 1), ball({3, 0, 0}, 1)}).scene);
    const auto far = balls.closest_hit({.origin = {3e38, 0, 0}, .direction = {-1e38, 0, 0}});
    REQUIRE(far);
    CHECK(far->t == 3);
    CHECK(far->object == 0);  // from there both are at t = 3: a tie
}

TEST_CASE("CompiledScene: outlives the Scene and every described object, and can be moved", "[compile]") {
    const ZooScene zoo = zoo_mixed(403);
    const auto compile_and_forget = [](std::uint64_t seed) {
        const ZooScene temporary = zoo_mixed(seed);
        return compile(temporary.scene);
    };
    CompiledScene moved = compile_and_forget(404);
    moved = compile_and_forget(403);
    const CompiledScene compiled(std::move(moved));
    const CompiledScene expected = compile(zoo.scene);
    Random random(321);
    int differing = 0;
    for (int i = 0; i < 3000; ++i) {
        const Ray ray = random_ray(random, zoo.targets);
        const auto a = compiled.closest_hit(ray), b = expected.closest_hit(ray);
        differing += a.has_value() != b.has_value() || (a && !same(*a, *b));
        if (a) differing += !(compiled.surface_at(ray, *a).normal == expected.surface_at(ray, *b).normal);
    }
    CHECK(differing == 0);
    CHECK(compiled.name() == "mixed 403");
}

TEST_CASE("compile: the same scene gives the same tables on any number of threads", "[compile]") {
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 7);
    Scene scene = zoo_mixed(405).scene;
    scene.add(std::make_shared<Mesh>(icosphere(6), nullptr));  // so large that many tasks build its tree
    const auto compile_on = [&](int threads) {
        return tbb::task_arena(threads).execute([&] { return compile(scene); });
    };
    const CompiledScene one = compile_on(1);
    for (const int threads : {1, 7}) check_same(one, compile_on(threads));
}

TEST_CASE("compile: features name what is in the scene and nothing else", "[compile]") {
    const Object mesh = std::make_shared<Mesh>(icosphere(1), nullptr);
    const CompiledScene balls = compile(zoo_of("balls", {ball({0, 0, 0}, 1)}).scene);
    CHECK(has_feature(balls, "sphere"));
    for (const char* absent : {"quad", "mesh", "instance", "medium", "foreign-shape", "texture", "triangle"})
        CHECK_FALSE(has_feature(balls, absent));
    CHECK(balls.features().find("mo") == std::string::npos);  // no motion of any kind

    const CompiledScene all = compile(
        zoo_of("all", {std::make_shared<Quad>(Point3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, nullptr), mesh,
                       std::make_shared<Instance>(mesh, Transform::translate({1, 2, 3})),
                       std::make_shared<ConstantMedium>(ball({}, 1), 1, Color{}), std::make_shared<Stranger>(mesh),
                       std::make_shared<Sphere>(
                           Point3{9, 9, 9}, 1.0,
                           std::make_shared<Lambertian>(std::make_shared<Checker>(1, Color{}, Color{1, 1, 1})))})
            .scene);
    for (const char* present : {"sphere", "quad", "mesh", "instance", "medium", "foreign-shape", "texture"})
        CHECK(has_feature(all, present));
    CHECK_FALSE(has_feature(all, "triangle"));
    const CompiledScene moving =
        compile(zoo_of("moving", {std::make_shared<Sphere>(Point3{}, Point3{1, 0, 0}, 1.0, nullptr)}).scene);
    CHECK(moving.features() != balls.features());
    CHECK(compile(Scene{}).features().empty());
}

TEST_CASE("compile: stats count primitives, degenerate triangles, lights and memory", "[compile]") {
    const auto lamp = std::make_shared<DiffuseLight>(Color{4, 4, 4}),
               dark = std::make_shared<DiffuseLight>(Color{0, 0, 0});
    const auto grey = std::make_shared<Lambertian>(Color{0.5, 0.5, 0.5});
    MeshData data = cube_mesh();
    data.triangles.push_back({3, 3, 4});
    Scene scene;
    scene.add(std::make_shared<Mesh>(data, grey));
    scene.add(std::make_shared<Quad>(Point3{0, 9, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}, lamp));
    scene.add(std::make_shared<Triangle>(Point3{0, 9, 5}, Point3{1, 9, 5}, Point3{0, 9, 6}, lamp));
    scene.add(std::make_shared<Sphere>(Point3{5, 9, 5}, 1.0, lamp));
    scene.add(std::make_shared<Sphere>(Point3{9, 9, 5}, 1.0, grey));
    const SceneStats stats = compile(scene).stats();
    CHECK(stats.degenerate == 1);
    CHECK(stats.lights == 3);
    CHECK(stats.primitives == 17);
    CHECK(stats.memory_bytes > 13 * sizeof(Index3) + 8 * sizeof(Float3));
    CHECK(stats.seconds >= 0);
    scene.add(std::make_shared<Mesh>(icosphere(3), grey));
    CHECK(compile(scene).stats().memory_bytes > stats.memory_bytes + icosphere(3).triangles.size() * sizeof(Index3));

    const SceneStats empty = compile(Scene{}).stats();
    CHECK((empty.primitives == 0 && empty.lights == 0 && empty.degenerate == 0));
    CHECK_FALSE(compile(Scene{}).closest_hit(down(0, 0)));
    CHECK_FALSE(compile(Scene{}).any_hit(down(0, 0)));
}

TEST_CASE("compile: a medium whose boundary holds a medium is refused", "[compile]") {
    const Object fog = std::make_shared<ConstantMedium>(ball({}, 1), 1, Color{});
    for (const Object& boundary :
         {fog, Object(std::make_shared<Instance>(fog, Transform::translate({1, 0, 0}))),
          Object(std::make_shared<HittableList>(std::vector<Object>{ball({3, 0, 0}, 1), fog}))})
        CHECK_THROWS_AS(compile(zoo_of("nested", {std::make_shared<ConstantMedium>(boundary, 1, Color{})}).scene),
                        ArgumentError);
}

TEST_CASE("compile: an object that contains itself is refused", "[compile]") {
    class Loop final : public Hittable {
    public:
        Box bounds() const override { return {{0, 0, 0}, {1, 1, 1}}; }
        std::optional<Hit> hit(const Ray&) const override { return std::nullopt; }
        void lower(RecordSink& sink) const override {
            sink.instance(
                {Transform{}, Transform{}, sink.blas(self.lock(), [&](RecordSink& inner) { lower(inner); }), false});
        }
        std::weak_ptr<const Hittable> self;
    };
    const auto loop = std::make_shared<Loop>();
    loop->self = loop;
    Scene scene;
    scene.add(loop);
    CHECK_THROWS_AS(compile(scene), ArgumentError);
}

}  // namespace limn::queries_test
