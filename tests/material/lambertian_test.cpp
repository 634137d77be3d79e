#include "limn/scene/material/lambertian.h"

#include <cmath>

#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/material/isotropic.h"
#include "limn/scene/texture/checker.h"
#include "material/lobe.h"

namespace limn::lambertian_test {

using namespace test;

TEST_CASE("Lambertian: samples follow the density, and nothing is lost", "[material][lambertian]") {
    const Surface s = surface({1, -2, 3});
    const Lobe lobe(Lambertian({1, .5, 1}), s, normalize({2, 0, 1}), Vec3(s.normal));
    CHECK(lobe.p_value > kSamplerLevel);
    CHECK(lobe.absorbed == 0);
    CHECK(lobe.mean_weight.g == Approx(.5).epsilon(1e-9));
    CHECK(lobe.integral == Approx(.5).epsilon(1e-5));
    CHECK(lobe.worst_ratio < 1e-12);
}

TEST_CASE("Lambertian: with a shading normal samples follow the density that is left", "[material][lambertian]") {
    const Surface s = surface({0, 0, 1}, {1, 0, 1});
    const Lobe lobe(Lambertian({1, 1, 1}), s, normalize({-1, 0, 2}), Vec3(s.shading_normal));
    CHECK(lobe.p_value > kSamplerLevel);
    // The share of a cosine lobe beyond a plane tilted by angle a is (1 - cos a) / 2.
    const double lost = (1 - std::sqrt(.5)) / 2;
    CHECK(std::abs(lobe.absorbed - lost) < 4 * std::sqrt(lost / kDraws));
    CHECK(lobe.integral == Approx(1 - lost).epsilon(DirectionHistogram::kQuadratureError));
    CHECK(lobe.worst_ratio < 1e-12);
}

TEST_CASE("Lambertian: no sample below the geometric surface contributes", "[material][lambertian]") {
    std::mt19937_64 random(23);
    const Lambertian white({1, 1, 1});
    int violations = 0;
    for (int i = 0; i < kDraws; ++i) {
        const Surface s = surface(random_direction(random), random_direction(random));
        const Vec3 out = random_out(random, s), in = random_direction(random);
        const auto sample = white.sample(s, out, random3(random));
        if (sample && !(dot(sample->direction, s.normal) > 0 && sample->weight == Color{1, 1, 1} && sample->pdf > 0))
            ++violations;
        const ScatterValue value = white.value(s, out, in);
        if (dot(in, s.normal) <= 0 && !(is_black(value.value) && value.pdf == 0)) ++violations;
        if (!(value.value.r >= 0 && value.value.r <= 1 / kPi)) ++violations;
    }
    CHECK(violations == 0);
}

TEST_CASE("Lambertian: light goes both ways alike", "[material][lambertian]") {
    std::mt19937_64 random(24);
    const Lambertian material({.2, .5, .8});
    for (int i = 0; i < 1000; ++i) {
        const Surface s = surface(random_direction(random));
        const Vec3 a = random_out(random, s), b = random_out(random, s);
        const double there = material.value(s, a, b).value.g / dot(b, s.normal);
        CHECK(there == Approx(.5 / kPi));
        CHECK(there == Approx(material.value(s, b, a).value.g / dot(a, s.normal)));
    }
}

TEST_CASE("Lambertian: the weight is the albedo, bit for bit, at the point of the surface", "[material][lambertian]") {
    const Color even{.1, .7, .3}, odd{.9, .2, .6};
    const Lambertian material(std::make_shared<Checker>(1, even, odd));
    Surface s = surface({0, 0, 1});
    for (const double x : {0.5, 1.5}) {
        s.position = {x, .5, .5};
        const auto sample = material.sample(s, {0, 0, 1}, {.3, .6, .5});
        REQUIRE(sample);
        CHECK(sample->weight == (x < 1 ? even : odd));
    }
}

TEST_CASE("Isotropic: samples follow the density on the whole sphere, and nothing is lost", "[material][isotropic]") {
    const Lobe lobe(Isotropic({1, .25, 1}), Surface{}, {0, 0, 1}, {0, 0, 1});
    CHECK(lobe.p_value > kSamplerLevel);
    CHECK(lobe.absorbed == 0);
    CHECK(lobe.mean_weight.g == Approx(.25).epsilon(1e-9));
    CHECK(lobe.integral == Approx(.25).epsilon(1e-5));
    CHECK(lobe.worst_ratio < 1e-12);
}

TEMPLATE_TEST_CASE("Diffuse materials: an albedo below 0 or above 1 is refused", "[material]", Lambertian, Isotropic) {
    for (const double bad : {-0.1, 1.1, std::nan(""), kInfinity}) {
        CHECK_THROWS_AS(TestType(Color{bad, 0, 0}), ArgumentError);
        CHECK_THROWS_AS(TestType(Color{0, bad, 0}), ArgumentError);
        CHECK_THROWS_AS(TestType(Color{0, 0, bad}), ArgumentError);
    }
    CHECK_THROWS_AS(TestType(std::shared_ptr<const Texture>()), ArgumentError);
    CHECK_NOTHROW(TestType(Color{1, 1, 1}));
}

}  // namespace limn::lambertian_test
