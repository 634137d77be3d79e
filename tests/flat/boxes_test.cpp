// The tree may not lose what the primitives find: flat boxes, and hits exactly where the range ends.
#include <limits>

#include "catch.h"
#include "flat/scene.h"
#include "limn/query/compiled_scene.h"
#include "support/scene_zoo.h"
#include "support/tally.h"

namespace limn::boxes_test {

using namespace test;

TEST_CASE("CompiledScene: flat boxes far from the origin lose no ray", "[compile][boxes]") {
    Random random(353);
    std::vector<Object> walls;
    for (int i = 0; i < 64; ++i)
        walls.push_back(
            std::make_shared<Quad>(Point3{1e5, static_cast<double>(i), 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, nullptr));
    const CompiledScene compiled = compile(zoo_of("walls", walls).scene);
    int misses = 0;
    for (int i = 0; i < 100000; ++i) {
        const Point3 aim{1e5, random.uniform(0.01, 63.99), random.uniform(0.01, 0.99)};
        const Point3 origin =
            i % 2 ? Point3{1e5 - 10, aim.y, aim.z}
                  : aim + random.uniform(0.1, 100) * normalize(Vec3{-1, random.uniform(-1, 1), random.uniform(-1, 1)});
        const Ray ray{.origin = origin, .direction = i % 2 ? Vec3{1, -0.0, 0} : aim - origin};
        misses += !compiled.closest_hit(ray) || !compiled.any_hit(ray);
    }
    CHECK(misses == 0);
}

TEST_CASE("CompiledScene: a hit exactly at t_max is found, and none at t_min", "[compile][boxes]") {
    // The rounding of a box's near side may not put it behind what is in it.
    for (const ZooScene& zoo : {zoo_mesh(), zoo_of_kind("spheres", 0, 40, 200), zoo_of_kind("quads", 3, 40, 203),
                                zoo_instances(), zoo_media()}) {
        const CompiledScene compiled = compile(zoo.scene);
        Random random(354);
        Tally tally;
        for (int i = 0; i < 30000; ++i) {
            Ray ray = random_ray(random, zoo.targets);
            const auto hit = compiled.closest_hit(ray);
            if (!hit || is_at_origin(ray, hit->t)) continue;
            ++tally.hits;
            ray.t_max = hit->t;
            const auto again = compiled.closest_hit(ray);
            if (!again || again->t != hit->t || !compiled.any_hit(ray)) tally.fault(ray, "lost at t_max");
            ray.t_max = std::nextafter(hit->t, -kInfinity);
            if (ray.t_max >= ray.t_min && compiled.any_hit(ray)) tally.fault(ray, "a nearer hit than the nearest");
            ray.t_min = hit->t, ray.t_max = kInfinity;
            const auto next = compiled.closest_hit(ray);
            if (next && next->t <= hit->t) tally.fault(ray, "hit at t_min");
        }
        INFO(zoo.name << ": " << tally.first);
        CHECK(tally.wrong == 0);
        CHECK(tally.hits > 1000);
    }
}

TEST_CASE("CompiledScene: a box in float is the smallest around the one in double", "[compile][boxes]") {
    Random random(359);
    constexpr float kFar = std::numeric_limits<float>::infinity();
    for (int i = 0; i < 1000; ++i) {
        const auto ball = std::make_shared<Sphere>(Point3{} + random.in_cube(100), random.uniform(0.1, 10), nullptr);
        Scene scene;
        for (std::size_t k = 0; k <= flat::kMaxBlock; ++k) scene.add(ball);  // a leaf alone has no node
        const CompiledScene compiled = compile(scene);
        const flat::Node& node = compiled.flat().nodes.front();
        const double scale = compiled.flat().blases.front().scale;
        Box box = ball->bounds();
        for (std::size_t a = 0; a < 3; ++a) {
            const float lower = node.planes[a][0], upper = node.planes[3 + a][0];
            box.lower[a] *= scale, box.upper[a] *= scale;
            CHECK((lower <= box.lower[a] && std::nextafter(lower, kFar) > box.lower[a]));
            CHECK((upper >= box.upper[a] && std::nextafter(upper, -kFar) < box.upper[a]));
        }
    }
}

}  // namespace limn::boxes_test
