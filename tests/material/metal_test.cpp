#include "limn/scene/material/metal.h"

#include <cmath>

#include "catch.h"
#include "limn/math/error.h"
#include "material/lobe.h"

namespace limn::metal_test {

using namespace test;

namespace {

const Surface kFloor = surface({0, 0, 1});
const Color kWhite{1, 1, 1};

// A direction at this angle from +z.
Vec3 from_z(double degrees) { return {std::sin(radians(degrees)), 0, std::cos(radians(degrees))}; }

Vec3 mirrored(const Vec3& w) { return {-w.x, -w.y, w.z}; }

}  // namespace

TEST_CASE("Metal: without fuzz a perfect mirror that nothing else can sample", "[material][metal]") {
    std::mt19937_64 random(1);
    const Metal mirror({.7, .6, .5});
    for (int i = 0; i < 1000; ++i) {
        const Vec3 out = random_out(random, kFloor);
        const auto sample = mirror.sample(kFloor, out, random3(random));
        REQUIRE(sample);
        CHECK(length(sample->direction - mirrored(out)) <= gamma(4));
        CHECK(sample->weight == Color{.7, .6, .5});
        CHECK(sample->pdf == 0);
        CHECK(mirror.value(kFloor, out, sample->direction).pdf == 0);
        CHECK(is_black(mirror.value(kFloor, out, sample->direction).value));
    }
}

TEST_CASE("Metal: mirrors about the shading normal, absorbs below the geometric one", "[material][metal]") {
    const Surface s = surface({0, 0, 1}, from_z(30));
    const auto sample = Metal(kWhite).sample(s, from_z(0), {});
    REQUIRE(sample);
    CHECK(length(sample->direction - from_z(60)) <= gamma(8));
    CHECK_FALSE(Metal(kWhite).sample(s, from_z(-50), {}));
}

TEST_CASE("Metal: fuzzy samples follow the density, steep and grazing, narrow and wide", "[material][metal]") {
    for (const auto& [fuzz, degrees] : {std::pair(.1, 30.0), std::pair(.3, 20.0), std::pair(.3, 80.0),
                                        std::pair(.7, 89.0), std::pair(1.0, 0.0), std::pair(1.0, 60.0)}) {
        CAPTURE(fuzz, degrees);
        const Vec3 out = from_z(degrees);
        // The histogram's edge lies where the density ends abruptly, at the rim of the lobe or at the horizon.
        const bool cut = radians(degrees) + std::asin(fuzz) > kPi / 2;
        const Lobe lobe(Metal({1, .5, 1}, fuzz), kFloor, out, cut ? from_z(0) : mirrored(out),
                        cut ? kPi / 2 : std::asin(fuzz));
        CHECK(lobe.p_value > kSamplerLevel);
        CHECK(lobe.worst_ratio < 1e-12);
        // What is not absorbed is reflected: the loss at grazing angles is all there is.
        CHECK(lobe.mean_weight.g == Approx(.5 * (1 - lobe.absorbed)).epsilon(1e-9));
        CHECK(lobe.integral <= .5 * (1 + DirectionHistogram::kQuadratureError));
        const double sigma = .5 * std::sqrt(std::max(lobe.absorbed, 1.0 / kDraws) / kDraws);
        CHECK(std::abs(lobe.integral - lobe.mean_weight.g) < 4 * sigma + .5 * DirectionHistogram::kQuadratureError);
    }
}

TEST_CASE("Metal: nothing is absorbed where the fuzz cannot reach the surface", "[material][metal]") {
    // asin(.3) = 17.46 degrees: directions at 70 degrees from the normal are 20 above the surface.
    std::mt19937_64 random(2);
    const Metal metal(kWhite, .3);
    double widest = 0;
    for (int i = 0; i < 100'000; ++i) {
        const auto sample = metal.sample(kFloor, from_z(70), random3(random));
        REQUIRE(sample);
        widest = std::max(widest, std::acos(std::min(1.0, dot(sample->direction, mirrored(from_z(70))))));
    }
    CHECK(widest <= std::asin(.3) + 1e-12);
    CHECK(widest > .98 * std::asin(.3));
}

TEST_CASE("Metal: the density at the mirror direction is that of the ball's diameter", "[material][metal]") {
    // s from 1 - f to 1 + f: ((1 + f)^3 - (1 - f)^3) / (4 pi f^3).
    for (const double f : {1e-6, .01, .3, 1.0}) {
        const double expected = (6 * f + 2 * f * f * f) / (4 * kPi * f * f * f);
        CHECK(Metal(kWhite, f).value(kFloor, from_z(0), from_z(0)).pdf == Approx(expected));
        CHECK(Metal(kWhite, f).value(kFloor, from_z(0), from_z(95)).pdf == 0);
    }
}

TEST_CASE("Metal: the density of a narrow lobe does not drown in rounding", "[material][metal]") {
    // Half way to the rim, where sin = f / 2: h = f sqrt(3) / 2, and c is 1 to twelve digits.
    const double f = 1e-6, h = f * std::sqrt(.75);
    const double expected = h * (3 + h * h) / (2 * kPi * f * f * f);
    CHECK(Metal(kWhite, f).value(kFloor, from_z(0), Vec3{f / 2, 0, 1}).pdf == Approx(expected).epsilon(1e-9));
}

TEST_CASE("Metal: the smallest fuzz gives finite densities", "[material][metal]") {
    for (const double fuzz : {5e-324, 1e-200, 1e-110, 1e-17, 0x1p-53, 1e-12, 1e-8})
        for (const double degrees : {0.0, 40.0}) {
            const auto sample = Metal(kWhite, fuzz).sample(kFloor, from_z(degrees), {.3, .7, .9});
            REQUIRE(sample);
            CAPTURE(fuzz, degrees, sample->pdf);
            CHECK(is_unit(sample->direction));
            CHECK((std::isfinite(sample->pdf) && sample->pdf >= 0));
            CHECK(std::isfinite(Metal(kWhite, fuzz).value(kFloor, from_z(degrees), from_z(-degrees)).pdf));
            CHECK(length(sample->direction - from_z(-degrees)) <= 2 * fuzz + gamma(8));
        }
}

TEST_CASE("Metal: a displacement that cancels the mirror direction is absorbed", "[material][metal]") {
    const Random3 random{.8, .2, kAlmostOne};
    const Vec3 p = sample_uniform_ball(random.x, random.y, random.z);
    CHECK_FALSE(Metal(kWhite, 1).sample(kFloor, {p.x, p.y, -p.z}, random));
}

TEST_CASE("Metal: impossible arguments are refused", "[material][metal]") {
    for (const double bad : {-0.1, 1.1, std::nan(""), kInfinity}) {
        CHECK_THROWS_AS(Metal(kWhite, bad), ArgumentError);
        CHECK_THROWS_AS(Metal(Color{bad, 0, 0}), ArgumentError);
    }
    CHECK_THROWS_AS(Metal(std::shared_ptr<const Texture>(), .1), ArgumentError);
}

}  // namespace limn::metal_test
