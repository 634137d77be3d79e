// The crossings of a medium's boundary, from which the way inside it is worked out: all of them, each once, each with
// its sense.
#include <algorithm>

#include "catch.h"
#include "flat/compile.h"
#include "limn/query/compiled_scene.h"
#include "property.h"
#include "support/grid.h"
#include "support/scene_zoo.h"
#include "support/tally.h"
#include "trace/traverse.h"

namespace limn::crossings_test {

using namespace test;
using trace::Crossing;

namespace {

Object fog(const Object& boundary) { return std::make_shared<ConstantMedium>(boundary, 1, Color{1, 1, 1}); }

flat::Scene flatten(const std::vector<Object>& objects) { return compiler::flatten(zoo_of("media", objects).scene); }

std::vector<Crossing> crossings(const flat::Scene& scene, const Ray& ray, std::size_t medium = 0) {
    std::vector<Crossing> found{{7, true}};  // to be replaced
    trace::crossings(scene, scene.media.at(medium), ray, found);
    std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
    return found;
}

// The definition: one hit() after the other.
std::vector<Crossing> walk(const Hittable& boundary, Ray ray) {
    std::vector<Crossing> found;
    while (const auto hit = boundary.hit(ray)) {
        found.push_back({hit->t, dot(hit->normal, ray.direction) < 0});
        ray.t_min = hit->t;
    }
    return found;
}

bool same(const std::vector<Crossing>& a, const std::vector<Crossing>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Crossing& x, const Crossing& y) { return x.t == y.t && x.inward == y.inward; });
}

}  // namespace

TEST_CASE("Crossings: the same as by asking the described boundary again and again, for every kind of shape",
          "[compile][crossings]") {
    Random random(390);
    const Object u = std::make_shared<Mesh>(u_shape(), nullptr);
    const Object shell = std::make_shared<HittableList>(std::vector<Object>{ball({0, 0, 0}, 2), ball({0, 0, 0}, -1)});
    const Transform pose =
        Transform::translate({1, -2, 0}) * Transform::rotate({1, 2, 3}, 40) * Transform::scale(-1, 2, 1);
    const Object boundaries[] = {
        ball({1, 2, 3}, 2),
        ball({1, 2, 3}, -2),
        std::make_shared<Sphere>(Point3{0, 0, 0}, Point3{2, 1, 0}, 1.5, nullptr),
        std::make_shared<Sphere>(Point3{0, 0, 0}, Point3{2, 1, 0}, -1.5, nullptr),
        make_box({-1, -2, -3}, {3, 1, 2}, nullptr),
        std::make_shared<HittableList>(std::vector<Object>{
            std::make_shared<Triangle>(Point3{0, 0, 0}, Point3{3, 0, 0}, Point3{0, 3, 1}, nullptr),
            std::make_shared<Triangle>(Point3{0, 0, 2}, Point3{0, 3, 3}, Point3{3, 0, 2}, nullptr)}),
        u,
        shell,
        std::make_shared<Stranger>(shell),
        std::make_shared<Instance>(u, pose),
        std::make_shared<Instance>(shell, pose, Transform::translate({1, 1, 1}) * pose)};
    for (const Object& boundary : boundaries) {
        const ZooScene zoo = zoo_of("fog", {fog(boundary)});
        const flat::Scene scene = compiler::flatten(zoo.scene);
        REQUIRE(scene.media.size() == 1);
        Tally tally;
        for (int i = 0; i < 2000; ++i) {
            Ray ray{.origin = random.in_box(zoo.targets.region),
                    .direction = random.log_uniform(0.1, 10) * random.unit()};
            if (i % 2) ray.origin = ray.origin - 5 * ray.direction;
            if (i % 3 == 0) ray.t_min = random.uniform(-1, 5);
            if (i % 5 == 0) ray.t_max = std::max(ray.t_min, random.uniform(0, 9));
            ray.time = random.uniform();
            const auto expected = walk(*boundary, ray);
            tally.hits += expected.size();
            if (!same(crossings(scene, ray), expected)) tally.fault(ray, "other crossings");
            const flat::RawHit first = trace::closest_boundary(scene, scene.media[0], ray);
            if (expected.empty() ? first.primitive != flat::RawHit::kMiss : first.t != expected[0].t)
                tally.fault(ray, "another first boundary");
        }
        INFO(tally.first);
        CHECK(tally.wrong == 0);
        CHECK(tally.hits > 500);
    }
}

TEST_CASE("Crossings: a closed surface is entered and left by turns, entered first from outside",
          "[compile][crossings]") {
    const flat::Scene scene = flatten({fog(std::make_shared<Mesh>(u_shape(), nullptr))});
    holds(
        [&] {
            // Coordinates of vertices and edges are whole: thirds of 1/64 keep off them.
            const Vec3 off{1.0 / 192, 1.0 / 480, 1.0 / 1344};
            Ray ray{.origin = draw_point(256) + off, .direction = draw_vec(64) + off};
            const auto found = crossings(scene, ray);
            const bool starts_inside = found.size() % 2 == 1;
            for (std::size_t i = 0; i < found.size(); ++i)
                RC_ASSERT(found[i].inward == ((i % 2 == 1) == starts_inside));
            // Behind the origin as many, but for the parity that says on which side it is.
            ray.direction = -ray.direction;
            RC_ASSERT(crossings(scene, ray).size() % 2 == found.size() % 2);
        },
        1000);
}

TEST_CASE("Crossings: a ray that is cut has each once, also where it is cut, and none where it touches",
          "[compile][crossings]") {
    const flat::Scene scene = flatten({fog(ball({0, 0, -10}, 2)), ball({0, 0, -5}, 1)});
    const auto count = [&](double t_min, double t_max) {
        return crossings(scene, {{0, 0, 0}, {0, 0, -1}, t_min, t_max, 0}).size();
    };
    CHECK(count(-kInfinity, kInfinity) == 2);  // the other ball is no boundary
    CHECK(count(0, kInfinity) == 2);
    CHECK(count(9, kInfinity) == 1);
    CHECK(count(0, 11) == 1);
    CHECK(count(0, std::nextafter(12, 0)) == 1);
    CHECK(count(0, std::nextafter(8, 0)) == 0);
    CHECK(count(std::nextafter(12, 13), kInfinity) == 0);
    for (const double cut : {std::nextafter(8, 0), 8.0, std::nextafter(8, 9), 12.0})
        CHECK(count(0, cut) + count(cut, kInfinity) == 2);
    CHECK(crossings(scene, {.origin = {2, 0, 0}, .direction = {0, 0, -1}}).empty());
}

TEST_CASE("Crossings: each medium of a scene has its own, wherever instances put it", "[compile][crossings]") {
    const Object inner = fog(ball({0, 0, 0}, 1));
    const Object both = std::make_shared<HittableList>(std::vector<Object>{ball({50, 0, 0}, 1), inner});
    const Transform far = Transform::translate({0, 20, 0}), doubled = Transform::scale(2, 2, 2);
    const flat::Scene scene = flatten(
        {ball({0, 90, 0}, 1), std::make_shared<Instance>(std::make_shared<Instance>(both, doubled), far), inner});
    REQUIRE(scene.media.size() == 2);
    const auto span = [&](std::size_t medium, double y) {
        const auto found = crossings(scene, {.origin = {0, y, 9}, .direction = {0, 0, -1}}, medium);
        return found.size() == 2 ? found[1].t - found[0].t : 0;
    };
    CHECK((span(0, 20) == 4 && span(1, 20) == 0));
    CHECK((span(0, 0) == 0 && span(1, 0) == 2));
    CHECK((scene.media[0].first_number == 2 && scene.media[1].first_number == 3));
    CHECK(scene.media[0].instance_count == 2);
    CHECK(scene.media[1].instance_count == 0);
    CHECK(scene.media[0].bounds.contains(Box{{-2, 18, -2}, {2, 22, 2}}));
    CHECK(Box{{-2.1, 17.9, -2.1}, {2.1, 22.1, 2.1}}.contains(scene.media[0].bounds));
    const auto number = [&](std::size_t medium, double y) {
        return trace::closest_boundary(scene, scene.media[medium], {.origin = {0, y, 9}, .direction = {0, 0, -1}})
            .primitive;
    };
    CHECK((number(0, 20) == 2 && number(1, 0) == 3));
}

TEST_CASE("are_occluded: boundaries that light passes straight through stop nothing, all else does",
          "[compile][crossings]") {
    // Somebody else's boundary, of a medium of their own.
    class Boundary final : public Hittable {
    public:
        Box bounds() const override { return inner_.bounds(); }
        std::optional<Hit> hit(const Ray& ray) const override {
            auto hit = inner_.hit(ray);
            if (hit) hit->index_matched = true;
            return hit;
        }

    private:
        Sphere inner_{{0, 0, 0}, 2, nullptr};
    };
    const Object boundary = std::make_shared<Boundary>();
    const Ray ray{.origin = {0, 0, 9}, .direction = {0, 0, -1}};
    const auto occluded = [&](const std::vector<Object>& objects, const Ray& r) {
        std::uint8_t found = 0;
        trace::are_occluded(flatten(objects), std::span(&r, 1), &found);
        return found != 0;
    };
    const auto any = [&](const std::vector<Object>& objects) { return trace::any_hit(flatten(objects), ray); };
    CHECK_FALSE(occluded({boundary}, ray));
    CHECK(any({boundary}));  // which asks for surfaces of any kind
    CHECK_FALSE(occluded({fog(ball({}, 2))}, ray));
    CHECK(occluded({std::make_shared<Stranger>(ball({}, 2))}, ray));
    CHECK(occluded({boundary, ball({}, 1)}, ray));
    // A surface of the same object behind its boundary still stops light.
    class Cloudy final : public Hittable {
    public:
        Box bounds() const override { return cloud_.bounds(); }
        std::optional<Hit> hit(const Ray& ray) const override {
            auto cloud = cloud_.hit(ray), core = core_.hit(ray);
            if (cloud) cloud->index_matched = true;
            return core && (!cloud || core->t < cloud->t) ? core : cloud;
        }

    private:
        Sphere cloud_{{0, 0, 0}, 2, nullptr}, core_{{0, 0, 0}, 1, nullptr};
    };
    const Object cloudy = std::make_shared<Cloudy>();
    CHECK(occluded({cloudy}, ray));
    CHECK_FALSE(occluded({cloudy}, {.origin = {1.5, 0, 9}, .direction = {0, 0, -1}}));
    CHECK_FALSE(occluded({cloudy}, {.origin = {0, 0, 9}, .direction = {0, 0, -1}, .t_max = 7.5}));
}

}  // namespace limn::crossings_test
