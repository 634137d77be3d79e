// Trees: the compiled scene and the described Bvh find what asking every object finds, to the bit.
#include "catch.h"
#include "hard/hard.h"
#include "support/scene_zoo.h"

namespace limn::bvh_test {

using namespace test;

namespace {

// A scene, asked three ways: every object, a described Bvh of them, compiled.
class ThreeWays {
public:
    explicit ThreeWays(const ZooScene& zoo)
        : name_(zoo.name),
          targets_(zoo.targets),
          list_(zoo.scene.objects()),
          tree_(zoo.scene.objects()),
          compiled_(compile(zoo.scene)) {}

    const Targets& targets() const { return targets_; }

    void ask(const Ray& ray, Tally& tally) const {
        ++tally.rays, ++tally.judged;
        const auto expected = list_.hit(ray);
        const auto by_tree = tree_.hit(ray);
        const auto found = compiled_.closest_hit(ray);
        if (by_tree.has_value() != expected.has_value() || found.has_value() != expected.has_value())
            return tally.fault(ray, expected ? "missed" : "false hit");
        if (compiled_.any_hit(ray) != found.has_value()) return tally.fault(ray, "any_hit");
        if (!found) return;
        ++tally.hits;
        if (by_tree->t != expected->t || found->t != expected->t) return tally.fault(ray, "t");
        if (by_tree->element != expected->element || found->primitive != expected->element)
            return tally.fault(ray, "primitive");
        if (by_tree->u != expected->u || by_tree->v != expected->v) return tally.fault(ray, "u, v");
        const bool has_uv = found->u != 0 || found->v != 0;  // a sphere's wait for surface_at
        if (has_uv && (found->u != expected->u || found->v != expected->v)) return tally.fault(ray, "u, v");
    }

    Tally ask(int rays, std::uint64_t seed) const {
        Random random(seed);
        Tally tally;
        for (int i = 0; i < rays; ++i) ask(random_ray(random, targets_), tally);
        return tally;
    }

    const std::string& name() const { return name_; }

private:
    std::string name_;
    Targets targets_;
    HittableList list_;
    Bvh tree_;
    CompiledScene compiled_;
};

}  // namespace

TEST_CASE("Trees: 200 mixed scenes are hit as object by object: same primitive, same bits of t, any as closest",
          "[hard][bvh]") {
    std::uint64_t hits = 0;
    for (std::uint64_t i = 0; i < 200; ++i) {
        const ThreeWays scene(zoo_mixed(3100 + i));
        const Tally tally = scene.ask(count(1e5), 3400 + i);
        check(tally, scene.name());
        hits += tally.hits;
    }
    CHECK(hits > static_cast<std::uint64_t>(count(1e5)) * 20);
}

TEST_CASE("Trees: many of a kind, instances in instances, media and strangers are hit as object by object",
          "[hard][bvh]") {
    std::uint64_t seed = 3700;
    for (std::size_t kind = 0; kind < 5; ++kind) {
        const ThreeWays scene(zoo_of_kind("kind " + std::to_string(kind), kind, 60, ++seed));
        check(scene.ask(count(1e6), ++seed), scene.name());
    }
    for (const ZooScene& zoo : {zoo_mesh(), zoo_instances(), zoo_media(), zoo_strangers(), zoo_scales()}) {
        const ThreeWays scene(zoo);
        const Tally tally = scene.ask(count(1e6), ++seed);
        check(tally, scene.name());
        CHECK(tally.hits > tally.rays / 50);
    }
}

TEST_CASE("Trees: a mesh of a millimetre a hundred kilometres out, in a ground sphere, among small spheres, is found",
          "[hard][bvh]") {
    Random random(3300);
    const Point3 place{1e5, 0, 0};
    std::vector<Object> objects{ball({0, -1e6, 0}, 1e6),
                                std::make_shared<Mesh>(icosphere(3, 1e-3, place - Point3{}), nullptr)};
    for (int i = 0; i < count(1e6); ++i)
        objects.push_back(ball(place + random.in_cube(random.log_uniform(1e-3, 100)), random.log_uniform(1e-6, 1e-2)));
    ZooScene zoo = zoo_of("a mesh of 1e-3 at 1e5", objects);
    zoo.targets = {{place - Vec3{1, 1, 1}, place + Vec3{1, 1, 1}}, {}};
    const MeshData& mesh = static_cast<const Mesh&>(*objects[1]).data();
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) zoo.targets.points.push_back(vertex(mesh, i));
    const ThreeWays scene(zoo);
    const Tally tally = scene.ask(std::max(1000, count(1e4)), 3301);
    check(tally, scene.name());
    CHECK(tally.hits > tally.rays / 2);
}

TEST_CASE("Trees: 0, 1, 2, 3 and 2^k +- 1 primitives, all apart or all in one place, are hit as object by object",
          "[hard][bvh]") {
    for (const std::size_t size : {0u,  1u,  2u,  3u,  4u,  5u,  7u,   8u,   9u,   15u,  16u,  17u,
                                   31u, 32u, 33u, 63u, 64u, 65u, 127u, 128u, 129u, 255u, 256u, 257u}) {
        Random random(3500 + size);
        std::vector<Object> apart, together, flat;
        for (std::size_t i = 0; i < size; ++i) {
            apart.push_back(random_shape(random, i % 5));
            together.push_back(ball({1, 2, 3}, 1));
            flat.push_back(
                std::make_shared<Quad>(Point3{static_cast<double>(i), 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, nullptr));
        }
        for (const auto& objects : {apart, together, flat}) {
            const ThreeWays scene(zoo_of(std::to_string(size) + " primitives", objects));
            check(scene.ask(count(1e4), 3600 + size), scene.name());
        }
    }
}

TEST_CASE("Trees: objects with empty boxes, lists of nothing and endless shapes among others change no answer",
          "[hard][bvh]") {
    class Nothing final : public Hittable {
    public:
        Box bounds() const override { return {}; }
        std::optional<Hit> hit(const Ray&) const override { return std::nullopt; }
    };
    class Endless final : public Hittable {  // y = -3, everywhere
    public:
        Box bounds() const override { return {{-kInfinity, -3, -kInfinity}, {kInfinity, -3, kInfinity}}; }
        std::optional<Hit> hit(const Ray& ray) const override {
            const double t = (-3 - ray.origin.y) / ray.direction.y;
            if (!is_usable(ray) || ray.direction.y == 0 || !(t > ray.t_min && t <= ray.t_max) || t == kInfinity)
                return std::nullopt;
            return Hit{.t = t, .normal = {0, 1, 0}};
        }
    };
    Random random(3700);
    for (std::size_t shapes = 0; shapes < 6; ++shapes) {
        std::vector<Object> objects{std::make_shared<Nothing>(), std::make_shared<HittableList>(),
                                    std::make_shared<Bvh>(std::vector<Object>{}),
                                    std::make_shared<Instance>(std::make_shared<HittableList>(), Transform{})};
        for (std::size_t i = 0; i < shapes; ++i) objects.push_back(random_shape(random, i % 5));
        if (shapes % 2) objects.push_back(std::make_shared<Endless>());
        const ThreeWays scene(zoo_of("with " + std::to_string(shapes) + " shapes", objects));
        check(scene.ask(count(1e5), 3701 + shapes), scene.name());
    }
}

TEST_CASE("Trees: of many exact copies the first is hit, whatever stands around them", "[hard][bvh]") {
    Random random(3800);
    for (int set = 0; set < 40; ++set) {
        const Object shape = random_shape(random, static_cast<std::size_t>(set) % 5, 1);
        std::vector<Object> objects;
        for (int i = 0; i < 60; ++i) objects.push_back(i % 3 == 0 ? shape : random_shape(random, random.index(5), 1e3));
        const ThreeWays scene(zoo_of("copies, set " + std::to_string(set), objects));
        ZooScene aim = zoo_of("aim", {shape});
        Tally tally;
        for (int i = 0; i < count(1e5); ++i) scene.ask(random_ray(random, aim.targets), tally);
        check(tally, scene.name());
    }
}

}  // namespace limn::bvh_test
