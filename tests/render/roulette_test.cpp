// Russian roulette, which ends unlimited paths, changes no mean.
#include "limn/scene/material/dielectric.h"
#include "render/single_ray.h"
#include "support/solid_angle.h"

namespace limn::roulette_test {

using namespace test;

TEST_CASE("Roulette: ends paths without a change of their mean, wherever they go", "[render][path]") {
    // A room lit at one end, so that a path's direction matters; after 40 segments 1e-6 of the light is left.
    const CompiledScene scene = compile_with(sky(0), {make_box({-1, -1, -1.5}, {1, 1, 1.5}, grey(0.7)),
                                                      quad({-0.9, -0.9, -1.4}, {1.8, 0, 0}, {0, 1.8, 0}, lamp(3))});
    const Ray ray{.origin = {0, 0, 0}, .direction = {0.2, 0.1, 1}};
    for (const Estimator estimator : {Estimator::path, Estimator::naive})
        check_same(along(scene, ray, kUnlimitedDepth, estimator, 20'000), along(scene, ray, 40, estimator, 10'000),
                   2e-2);
}

TEST_CASE("Roulette: does not choose among directions", "[render][path]") {
    // Panes that do not bend light make the floor the fourth vertex, where roulette begins; it survives one of 10
    // times.
    std::vector<Object> objects{floor_of(grey(0.1))};
    for (const double y : {0.1, 0.2, 0.3})
        objects.push_back(quad({-0.3, y, 0.0}, {0.6, 0, 0}, {0, 0.01, 0.6}, std::make_shared<Dielectric>(1.0)));
    for (const Vec3& side : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
        const Vec3 along_floor = cross(side, Vec3{0, 1, 0});
        const Point3 q = Point3{} + 3 * side - 4 * along_floor + Vec3{0, 1.5, 0};
        const Vec3 u = 8 * along_floor, v{0, 4, 0};
        std::vector<Object> with_lamp = objects;
        with_lamp.push_back(quad(q, u, v, lamp(2)));
        const double truth = 0.1 * 2 / kPi * std::abs(vector_irradiance({q, q + u, q + u + v, q + v}, {}).y);
        const Ray ray{.origin = {0, 0.4, 0.4}, .direction = {0, -1, -1}};
        CAPTURE(side.x, side.z);
        check_mean(along(compile_with(sky(0), with_lamp), ray, kUnlimitedDepth, Estimator::naive, 60'000), truth, 4e-2);
    }
}

TEST_CASE("Roulette: keeps light of one colour alone", "[render][path]") {
    for (const Color& albedo : {Color{0.5, 0, 0}, Color{0, 0.5, 0}, Color{0, 0, 0.5}}) {
        std::vector<Object> objects{floor_of(std::make_shared<Lambertian>(albedo))};
        for (const double y : {0.1, 0.2, 0.3})
            objects.push_back(quad({-0.3, y, 0.0}, {0.6, 0, 0}, {0, 0.01, 0.6}, std::make_shared<Dielectric>(1.0)));
        const Ray ray{.origin = {0, 0.4, 0.4}, .direction = {0, -1, -1}};
        check_mean(along(compile_with(sky(1), objects), ray, kUnlimitedDepth, Estimator::path, 20'000), 0.5 / 3, 1e-2);
    }
}

}  // namespace limn::roulette_test
