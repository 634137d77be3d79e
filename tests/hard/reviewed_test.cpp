// Rays that an earlier form of the kernels got wrong.
#include <cmath>
#include <memory>

#include "catch.h"
#include "limn/math/error.h"
#include "limn/query/compiled_scene.h"
#include "limn/scene/shape/bvh.h"
#include "limn/scene/shape/hittable_list.h"
#include "limn/scene/shape/instance.h"
#include "limn/scene/shape/mesh.h"
#include "limn/scene/shape/sphere.h"
#include "limn/scene/shape/triangle.h"

namespace limn::reviewed_test {

namespace {

CompiledScene scene_of(const std::shared_ptr<const Hittable>& object) {
    Scene scene;
    scene.add(object);
    return compile(scene);
}

}  // namespace

TEST_CASE("Triangle: a plane ahead is not taken for one behind where its determinant underflows", "[hard][reviewed]") {
    const auto triangle =
        std::make_shared<Triangle>(Point3{0, 0, 0}, Point3{0x1p-8, 0, 0}, Point3{0, 0x1p-8, 0}, nullptr);
    for (const double side : {1.0, -1.0}) {
        const Ray ray{.origin = {0x1p-10, 0x1p-10, side * 0x1p-53}, .direction = {0, 0, -side * 0x1p-1060}};
        const auto hit = triangle->hit(ray);
        REQUIRE(hit);
        CHECK(hit->t == 0x1p1007);
        CHECK(scene_of(triangle).closest_hit(ray)->t == 0x1p1007);
    }
}

TEST_CASE("Needles: a t just before their box is found by tree and scene too", "[hard][reviewed]") {
    MeshData data;
    data.vertices = {{0x1.720b2p-1f, 0x1.732bf6p-1f, -0x1.f23b98p-2f},
                     {0x1.720b2p-1f, 0x1.7337aap-1f, 0x1.97d7ccp+0f},
                     {0x1.720b2p-1f, 0x1.7362b2p-1f, -0x1.c71b16p-2f}};
    data.triangles = {{0, 1, 2}};
    const auto mesh = std::make_shared<Mesh>(data, nullptr);
    Ray ray{.origin = {0, 0, 0}, .direction = {0x1.fd51b6913d03cp-1, 0x1.fef38e925bdddp-1, 1}};
    const auto hit = mesh->hit(ray);
    REQUIRE(hit);
    ray.t_max = hit->t;
    const Bvh tree({mesh});
    CHECK(tree.hit(ray));
    CHECK(scene_of(mesh).closest_hit(ray));
    CHECK(scene_of(mesh).any_hit(ray));
}

TEST_CASE("Instance: boxes are met where the rounded direction tells little of the exact one", "[hard][reviewed]") {
    const Transform m{{{{-0.5, 0, 0, 0}, {0.7, 0.6, 2e-19, 0}, {-0.8, 0.8, -2e-19, 0}}}};
    const auto ball = std::make_shared<Sphere>(Point3{10, 0, 0}, 1, nullptr);
    const auto other = std::make_shared<Sphere>(Point3{-10, 0, 0}, 1, nullptr);
    const auto pair = std::make_shared<HittableList>();
    pair->add(ball);
    pair->add(other);
    const Ray ray{.origin = {0, 0, 0}, .direction = {-0.5, 0.7, -0.8}, .t_min = 5};
    const auto hit = scene_of(std::make_shared<Instance>(pair, m)).closest_hit(ray);
    REQUIRE(hit);
    CHECK(hit->t == Instance(ball, m).hit(ray)->t);
    CHECK(hit->t == Approx(9));
}

TEST_CASE("Instance: a direction that the rounded matrix takes to nothing is still one", "[hard][reviewed]") {
    const Transform m{{{{0x1.5423dbabd0f85p+0, 0x1.7c6523769e138p-2, 0x1.c19cbdd8d70ecp-1, -0x1.1e1672ac3c648p+0},
                        {-0x1.8194880127a88p-2, 0x1.1e1620bb1e67bp+1, 0x1.dc8de8bb3586ep-1, -0x1.b6f9ebba9c7acp+0},
                        {0x1.5423dbabd0f85p+0, 0x1.7c6523769e135p-2, 0x1.c19cbdd8d70ecp-1, -0x1.1153de02e237ep+1}}}};
    const Ray ray{.origin = {0x1.17769c9e9309ep-1, -0x1.255e05ccc683bp+1, -0x1.e357ec28fa194p-2},
                  .direction = {-0x1.68f9c60913e2ap+0, 0x1.993304709ed6bp-2, -0x1.68f9c60913e2ap+0}};
    REQUIRE(transform_vector(inverse(m), ray.direction) == Vec3{});
    const auto ball = std::make_shared<Instance>(
        std::make_shared<Sphere>(Point3{-0x1.11cb52a409p-10, -0x1.29b7d9bfc454p-5, -0x1.1ffe0c90f908p-6},
                                 0x1.4653d9318b25cp+0, nullptr),
        m);
    const auto hit = ball->hit(ray);
    REQUIRE(hit);
    CHECK(hit->t == Approx(0x1.352b816fbc267p-5).epsilon(0x1p-32));  // by exact arithmetic
    const CompiledScene scene = scene_of(ball);
    CHECK(scene.closest_hit(ray)->t == hit->t);
    CHECK(scene.any_hit(ray));
}

TEST_CASE("Triangle: beyond the largest float it is hit in a tree as well", "[hard][reviewed]") {
    const auto triangle = std::make_shared<Triangle>(Point3{0x1.4p+127, -0x1.4p+128, 0x1.6cp+129},
                                                     Point3{-0x1.2p+128, -0x1.ap+127, 0x1.88p+128},
                                                     Point3{0x1.8p+128, -0x1.4p+125, 0x1.f8p+129}, nullptr);
    const Ray ray{.origin = {0x1.a9p+133, -0x1.5ap+133, 0x1.01bp+135},
                  .direction = {-0x1.4p-704, 0x1p-704, -0x1.8p-703}};
    const auto hit = triangle->hit(ray);
    REQUIRE(hit);
    CHECK(hit->t == 0x1.5p+837);
    const CompiledScene scene = scene_of(triangle);
    REQUIRE(scene.closest_hit(ray));
    CHECK(scene.closest_hit(ray)->t == hit->t);
    CHECK(scene.any_hit(ray));
}

TEST_CASE("Instance: a matrix is refused where it is exactly singular, though its rounded determinant is not 0",
          "[hard][reviewed]") {
    Transform m;
    m.rows[0] = {0.1f, 0.1f, 0.2f, 0};
    m.rows[1] = {0.2f, 0.1f, 0.1f, 0};
    for (std::size_t j = 0; j < 3; ++j) m.rows[2][j] = m.rows[0][j] + m.rows[1][j];  // exact: they are float32
    CHECK_THROWS_AS(Instance(std::make_shared<Sphere>(Point3{0, 0, 0}, 1, nullptr), m), ArgumentError);
}

TEST_CASE("Sphere: of two roots that are one in double the nearer is not reported behind the farther one",
          "[hard][reviewed]") {
    const auto ball = std::make_shared<Sphere>(Point3{0.1, 0.2, 0.3}, 1.5, nullptr);
    const Transform turned = Transform::translate({0.5, -0.25, 1}) * Transform::rotate({1, 2, 3}, 40);
    const auto object =
        std::make_shared<Instance>(std::make_shared<Instance>(ball, Transform::scale(1, -0.5, 2)), turned);
    Ray ray{.origin = {0x1.b2e12baf37c85p-1, -0x1.d89e17d9be266p-3, 0x1.18f11d4d2bcbbp+119},
            .direction = {0, 0, -0x1.30b68d8d2c29p+591}};
    const auto hit = object->hit(ray);
    REQUIRE(hit);
    // Whatever interval holds it, it is the nearest; and without it there is none.
    const CompiledScene scene = scene_of(object);
    const std::vector<RayHit> all = scene.all_hits(ray);
    REQUIRE(!all.empty());
    CHECK(all.front().t == hit->t);
    ray.t_max = hit->t;
    CHECK(object->hit(ray)->t == hit->t);
    ray.t_max = std::nextafter(hit->t, 0);
    CHECK_FALSE(object->hit(ray));
    CHECK_FALSE(scene.closest_hit(ray));
    CHECK(scene.all_hits(ray).empty());
}

}  // namespace limn::reviewed_test
