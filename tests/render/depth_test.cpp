// max_depth counts ray segments: what the last one meets still counts, nothing after it.
#include "catch.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/metal.h"
#include "support/pictures.h"

namespace limn::depth_test {

using namespace test;

namespace {

const Camera kStraight = camera_at({0, 0, 5}, {0, 0, 0}, 0.1);

double seen(const std::vector<Object>& objects, double field, int depth, Estimator estimator = Estimator::path) {
    return mean(render(compile_with(sky(field), objects), kStraight, square(4, 64, depth, estimator)).image);
}

}  // namespace

TEST_CASE("Depth: one segment sees lamps and sky, and nothing that needs scattering", "[render][depth]") {
    for (const Estimator estimator : {Estimator::path, Estimator::naive}) {
        CHECK(seen({}, 0.5, 1, estimator) == 0.5);
        CHECK(seen({sphere({0, 0, 0}, 1, lamp(2))}, 0.5, 1, estimator) == 2);
        CHECK(seen({sphere({0, 0, 0}, 1, grey(1))}, 1, 1, estimator) == 0);
        CHECK(seen({sphere({0, 0, 0}, 1, std::make_shared<Metal>(Color{1, 1, 1}))}, 1, 1, estimator) == 0);
        CHECK(seen({sphere({0, 0, 0}, 1, grey(1)), quad({-9, -9, 9}, {18, 0, 0}, {0, 18, 0}, lamp(3))}, 0, 1,
                   estimator) == 0);
    }
}

TEST_CASE("Depth: two segments see one scattering", "[render][depth]") {
    for (const Estimator estimator : {Estimator::path, Estimator::naive}) {
        CHECK(seen({sphere({0, 0, 0}, 1, grey(0.5))}, 1, 2, estimator) == Approx(0.5).epsilon(1e-6));
        CHECK(seen({sphere({0, 0, 0}, 1, std::make_shared<Metal>(Color{0.8, 0.8, 0.8}))}, 1, 2, estimator) ==
              Approx(0.8).epsilon(1e-6));
        // A mirror before a mirror: two scatterings need three segments.
        const std::vector<Object> mirrors{
            quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, std::make_shared<Metal>(Color{0.5, 0.5, 0.5})),
            quad({-9, -9, 6}, {18, 0, 0}, {0, 18, 0}, std::make_shared<Metal>(Color{0.5, 0.5, 0.5}))};
        CHECK(seen(mirrors, 1, 2, estimator) == 0);
        for (const int depth : {2, 3, 4, 5, 50})
            CHECK(seen(mirrors, 1, depth, estimator) == 0);  // the light is between them for ever
    }
    // Through a pane of index 1: enter and leave, then the sky.
    const Object pane = make_box({-1, -1, -1}, {1, 1, 1}, std::make_shared<Dielectric>(1.0));
    CHECK(seen({pane}, 1, 2) == 0);
    CHECK(seen({pane}, 1, 3) == 1);
}

TEST_CASE("Depth: n mirrors need n + 1 segments", "[render][depth]") {
    // A corridor of mirrors at 45 degrees: each turns the ray once.
    const MaterialPtr mirror = std::make_shared<Metal>(Color{1, 1, 1});
    const std::vector<Object> periscope{
        quad({-1, -1, -1}, {0, 2, 2}, {2, 0, 0}, mirror),  // at the origin: -z becomes +y or -y
        quad({-1, -6, 4 - 5}, {0, 2, 2}, {2, 0, 0}, mirror), quad({-1, 4, -1}, {0, 2, 2}, {2, 0, 0}, mirror)};
    CHECK(seen(periscope, 1, 1) == 0);
    CHECK(seen(periscope, 1, 2) == 0);
    CHECK(seen(periscope, 1, 3) == Approx(1).epsilon(1e-6));
}

TEST_CASE("Depth: a light found by sampling counts as the segment that it stands for", "[render][depth]") {
    // Two diffuse surfaces and a lamp that only the second sees: lit from depth 3 on.
    const std::vector<Object> objects{quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, grey(1)),
                                      quad({-50, -50, 20}, {100, 0, 0}, {0, 100, 0}, grey(1)),
                                      quad({-20, -20, -1}, {40, 0, 0}, {0, 18, 0}, lamp(5))};
    for (const Estimator estimator : {Estimator::path, Estimator::naive}) {
        CHECK(seen(objects, 0, 2, estimator) == 0);
        CHECK(seen(objects, 0, 3, estimator) > 0);
    }
}

TEST_CASE("Depth: each further segment of a closed furnace adds its power of the albedo", "[render][depth]") {
    // A lamp for a wall, a diffuse ball inside a white furnace: here by a glass-free box, radiance sum of a^k.
    const MaterialPtr wall = grey(0.5);
    const CompiledScene scene = compile_with(sky(0), {sphere({0, 0, 0}, -1, wall), sphere({0, 0, 0}, 0.2, lamp(10))});
    const Camera camera = camera_at({0.6, 0, 0}, {1, 0, 0}, 60);
    const double k = 0.04;
    double truth = 0, bounce = 0.5 * 10 * k;
    for (int depth = 2; depth <= 5; ++depth) {
        truth += bounce;
        bounce *= 0.5 * (1 - k);
        check_mean(measure(scene, camera, square(8, 64, depth)), truth, 5e-3);
    }
}

TEST_CASE("Depth: passing the boundary of a medium is no segment", "[render][depth]") {
    const Object veil = std::make_shared<ConstantMedium>(sphere({0, 0, 0}, 1, grey(1)), 0, Color{});
    const Object own = std::make_shared<Stranger>(veil);
    for (const Object& object : {veil, own}) {
        CHECK(seen({object}, 0.5, 1) == 0.5);
        CHECK(seen({object, sphere({0, 0, 0}, 0.5, lamp(2))}, 0.5, 1) == 2);
        CHECK(seen({object, sphere({0, 0, 0}, 0.5, grey(0.5))}, 1, 2) == Approx(0.5).epsilon(1e-6));
    }
}

}  // namespace limn::depth_test
