// Emitters in motion, and many of them: sampling against scattering alone.
#include "render/single_ray.h"

namespace limn::many_lamps_test {

using namespace test;

TEST_CASE("Lamps: by both estimators one shines alike that instances move, whole, as a mesh, or a ball",
          "[render][lights]") {
    const Transform still = Transform::translate({-1.2, 2, 0}) * Transform::scale(1.5, 1.5, 1.5),
                    turned = Transform::translate({1, 2, 0.5}) * Transform::rotate({1, 2, 3}, 70) *
                             Transform::scale(1, 2, 0.7);
    const Vec3 u{0.8, 0.1, 0}, v{0.2, 0, 0.7};
    const Object objects[] = {quad({-0.4, 0, -0.3}, 2 * u, 2 * v, lamp(4)),
                              std::make_shared<Mesh>(cube_mesh(), lamp(2)), sphere({0.3, 0.2, 0}, 0.7, lamp(5))};
    for (std::size_t i = 0; i < 3; ++i) {
        const Transform end = i == 2 ? Transform::translate({2, 0.5, 0}) * still : turned;
        const Object moved = std::make_shared<Instance>(objects[i], still, end);
        const Object twice = std::make_shared<Instance>(moved, Transform{}, Transform::translate({0, 0.5, 1}));
        CAPTURE(i);
        const CompiledScene scene =
            compile_with(sky(0), {floor_of(grey(0.7)), twice, quad({-3, 0, -2}, {6, 0, 0}, {0, 4, 0}, grey(0.5))});
        REQUIRE(scene.stats().lights == (i == 1 ? 12 : 1));
        for (const double time : {0.2, 1.0})
            check_same(along(scene, at_floor(time), 4, Estimator::path, 20'000),
                       along(scene, at_floor(time), 4, Estimator::naive, 100'000), 3e-2);
    }
}

TEST_CASE("Lamps: by both estimators many close to a wall shine alike", "[render][lights]") {
    // So close that solid angles, areas and the way down the tree all matter.
    Random random(12);
    std::vector<Object> objects{floor_of(grey(0.6)), sphere({0, 0.4, 0}, 0.4, grey(0.7))};
    for (int i = 0; i < 40; ++i) {
        const Point3 p{random.uniform(-2, 2), random.log_uniform(0.01, 1.5), random.uniform(-2, 2)};
        const Vec3 u = 0.3 * random.unit(), v = 0.3 * random.unit();
        const MaterialPtr m = lamp(random.uniform(1, 5));
        if (i % 3 == 0)
            objects.push_back(quad(p, u, v, m));
        else if (i % 3 == 1)
            objects.push_back(std::make_shared<Triangle>(p, p + u, p + v, m));
        else
            objects.push_back(sphere(p, 0.1, m));
    }
    const CompiledScene scene = compile_with(sky(0), objects);
    const Camera camera = camera_at({0, 3, 6}, {0, 0.3, 0}, 35);
    check_same(measure(scene, camera, square(16, 16, 4)), measure(scene, camera, square(16, 64, 4, Estimator::naive)),
               1.5e-2);
}

}  // namespace limn::many_lamps_test
