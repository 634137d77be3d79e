#include "limn/scene/shape/constant_medium.h"

#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/shape/hittable_list.h"
#include "limn/scene/shape/mesh.h"
#include "limn/scene/shape/sphere.h"
#include "limn/scene/texture/solid.h"
#include "support/meshes.h"
#include "support/random_geometry.h"

namespace limn::medium_test {

using limn::test::Random;

TEST_CASE("ConstantMedium: hit is the crossing of its boundary, flagged index-matched", "[shape][medium]") {
    Random random(70);
    const auto mesh = std::make_shared<Mesh>(test::u_shape(), nullptr);
    const ConstantMedium medium(mesh, 0.7, Color{0.2, 0.4, 0.6});
    CHECK(medium.bounds() == mesh->bounds());
    CHECK(count_elements(medium) == mesh->data().triangles.size());
    test::Targets targets{mesh->bounds(), {}};
    for (std::uint32_t i = 0; i < 16; ++i) targets.points.push_back(test::vertex(mesh->data(), i));
    for (int i = 0; i < 5000; ++i) {
        const Ray ray = random_ray(random, targets);
        const auto a = mesh->hit(ray), b = medium.hit(ray);
        REQUIRE(a.has_value() == b.has_value());
        if (!a) continue;
        CHECK(b->index_matched);
        CHECK_FALSE(a->index_matched);
        CHECK((a->t == b->t && a->element == b->element && a->normal == b->normal));
        CHECK(b->material != nullptr);  // what fills it
    }
}

TEST_CASE("ConstantMedium: hit is pure, the same ray always gives the same answer", "[shape][medium]") {
    const ConstantMedium medium(std::make_shared<Sphere>(Point3{}, 1.0, nullptr), 3, Color{1, 1, 1});
    for (int i = 0; i < 100; ++i) CHECK(medium.hit({.origin = {0, 0, 5}, .direction = {0, 0, -1}})->t == 4);
    CHECK(medium.hit({.origin = {0, 0, 0}, .direction = {0, 0, -1}})->t == 1);  // from inside: the way out
}

TEST_CASE("ConstantMedium: what cannot be is refused by name, an invisible medium is not", "[shape][medium]") {
    const auto ball = std::make_shared<Sphere>(Point3{}, 1.0, std::make_shared<Dielectric>(1.5));
    const Color white{1, 1, 1};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double density : {-1.0, -1e-300, nan, kInfinity}) {
        CHECK_THROWS_AS(ConstantMedium(ball, density, white), ArgumentError);
        CHECK_THROWS_WITH(ConstantMedium(ball, density, white), Catch::Contains("density"));
    }
    CHECK_THROWS_WITH(ConstantMedium(nullptr, 1, white), Catch::Contains("boundary"));
    CHECK_THROWS_WITH(ConstantMedium(ball, 1, Color{1, 1.01, 1}), Catch::Contains("albedo"));
    CHECK_THROWS_AS(ConstantMedium(ball, 1, Color{-0.1, 1, 1}), ArgumentError);
    CHECK_THROWS_AS(ConstantMedium(ball, 1, Color{nan, 1, 1}), ArgumentError);
    CHECK_THROWS_AS(ConstantMedium(ball, 1, std::shared_ptr<const Texture>{}), ArgumentError);
    for (const double density : {0.0, 1e-30, 1e30}) CHECK_NOTHROW(ConstantMedium(ball, density, white));
    CHECK_NOTHROW(ConstantMedium(ball, 1, std::make_shared<SolidColor>(Color{0.5, 0.5, 0.5})));
}

}  // namespace limn::medium_test
