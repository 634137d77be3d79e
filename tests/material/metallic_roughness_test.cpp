#include "limn/scene/material/metallic_roughness.h"

#include <cmath>

#include "bsdf/albedo_table.h"
#include "catch.h"
#include "limn/limn.h"
#include "limn/math/error.h"
#include "material/lobe.h"
#include "material/microfacets.h"

namespace limn::metallic_roughness_test {

using namespace test;

namespace {

const Color kWhite{1, 1, 1};

std::shared_ptr<const Texture> solid(const Color& color) { return std::make_shared<SolidColor>(color); }

}  // namespace

TEST_CASE("MetallicRoughness: samples follow the density, at every roughness and mixture",
          "[material][metallic-roughness]") {
    for (const double metallic : {0.0, 0.5, 1.0})
        for (const double roughness : kGridRoughness) {
            CAPTURE(metallic, roughness);
            check_samples(MetallicRoughness(Color{.8, .4, .1}, metallic, roughness));
        }
}

TEST_CASE("MetallicRoughness: a white one loses no light, at any mixture, roughness, index and angle to 85 degrees",
          "[material][metallic-roughness]") {
    for (const double metallic : {0.0, 0.4, 1.0})
        for (const double index : {1.0, 1.5, 2.5})
            for (const double roughness : {0.1, 0.33, 0.6, 1.0})
                for (const double degrees : {0.0, 45.0, 70.0, 85.0}) {
                    if (metallic == 1 && index != 1.5) continue;
                    CAPTURE(metallic, index, roughness, degrees);
                    const MetallicRoughness white(kWhite, metallic, roughness, index);
                    CHECK(std::abs(reflected(white, at_angles(radians(degrees), 0.3)) - 1) < 1e-3);
                }
}

TEST_CASE("MetallicRoughness: without metal it is plastic, within what the tables are to each other",
          "[material][metallic-roughness]") {
    std::mt19937_64 random(3);
    const Color base{.2, .5, .9};
    for (const double roughness : {0.15, 0.4, 0.77, 1.0}) {
        const MetallicRoughness mixture(base, 0, roughness, 1.6);
        const Plastic plastic(base, roughness, 1.6);
        for (int i = 0; i < 200; ++i) {
            const Vec3 out = random_out(random, kUp), in = random_out(random, kUp);
            if (std::min(out.z, in.z) < 0.05) continue;
            CAPTURE(roughness, out.z, in.z);
            const Color a = mixture.value(kUp, out, in).value, b = plastic.value(kUp, out, in).value;
            CHECK(a.r == Approx(b.r).epsilon(1e-3));
            CHECK(a.b == Approx(b.b).epsilon(1e-3));
        }
    }
}

TEST_CASE("MetallicRoughness: of metal it is facets by Schlick's approximation, and what they scatter more than once",
          "[material][metallic-roughness]") {
    const double roughness = 0.5, alpha = roughness * roughness;
    const Color base{1, .7, .1};
    const MetallicRoughness metal(base, 1, roughness);
    const RoughConductor white(kWhite, roughness);
    const bsdf::AlbedoTable table = bsdf::albedo_of(alpha, alpha, 0);
    std::mt19937_64 random(3);
    for (int i = 0; i < 100; ++i) {
        const Vec3 out = random_out(random, kUp), in = random_out(random, kUp);
        if (std::min(out.z, in.z) < 0.05) continue;
        const Vec3 m = normalize(out + in);
        const double lambdas = ggx_lambda(out, alpha, alpha) + ggx_lambda(in, alpha, alpha);
        const double once = ggx_density(m, alpha, alpha) / (1 + lambdas) / (4 * out.z);
        const double all = white.value(kUp, out, in).value.g, often = all - once;
        const auto expected = [&](double f0) {
            // The mean of Schlick's reflectance over the projected hemisphere, by the midpoint rule.
            double mean = 0;
            for (int k = 0; k < 1000; ++k) {
                const double c = (k + 0.5) / 1000;
                mean += 2 * c * (f0 + (1 - f0) * std::pow(1 - c, 5)) / 1000;
            }
            const double e = table.mean_at(0), again = mean * mean * e / (1 - mean * (1 - e));
            return (f0 + (1 - f0) * std::pow(1 - dot(out, m), 5)) * once + again * often;
        };
        const Color value = metal.value(kUp, out, in).value;
        CHECK(value.r == Approx(all).epsilon(1e-3));
        CHECK(value.g == Approx(expected(base.g)).epsilon(1e-3));
        CHECK(value.b == Approx(expected(base.b)).epsilon(1e-3));
    }
}

TEST_CASE("MetallicRoughness: a mixture is that of its ends, and light goes both ways alike",
          "[material][metallic-roughness]") {
    std::mt19937_64 random(25);
    const Color base{.2, .5, .8};
    const MetallicRoughness none(base, 0, 0.4), some(base, 0.3, 0.4), all(base, 1, 0.4);
    for (int i = 0; i < 1000; ++i) {
        const Surface s = surface(random_direction(random));
        const Vec3 a = random_out(random, s), b = random_out(random, s);
        if (std::min(dot(a, s.normal), dot(b, s.normal)) < 1e-3) continue;
        const Color value = some.value(s, a, b).value;
        CHECK(value.r == Approx(0.7 * none.value(s, a, b).value.r + 0.3 * all.value(s, a, b).value.r).epsilon(1e-12));
        CHECK(value.g / dot(b, s.normal) == Approx(some.value(s, b, a).value.g / dot(a, s.normal)).epsilon(1e-7));
    }
}

TEST_CASE("MetallicRoughness: green of its texture is roughness and blue metallic, both times their factors",
          "[material][metallic-roughness]") {
    std::mt19937_64 random(7);
    const Color base{.2, .5, .8};
    const auto same = [&](const Color& texel, double metallic, double roughness, double m, double r) {
        const MetallicRoughness textured(solid(base), solid(texel), metallic, roughness), plain(base, m, r);
        for (int i = 0; i < 20; ++i) {
            const Vec3 a = random_out(random, kUp), b = random_out(random, kUp);
            const Random3 numbers = random3(random);
            CHECK(textured.value(kUp, a, b).value == plain.value(kUp, a, b).value);
            CHECK(textured.sample(kUp, a, numbers)->direction == plain.sample(kUp, a, numbers)->direction);
        }
    };
    same({0.3, 0.5, 0.25}, 0.5, 0.75, 0.125, 0.375);
    same({0, 3, 4}, 1, 0.5, 1, 1);    // clamped
    same({1, 0, 1}, 0, 1, 0, 0.001);  // as smooth as it gets
}

TEST_CASE("MetallicRoughness: a black base leaves the coat, and black metal nothing but its edge",
          "[material][metallic-roughness]") {
    CHECK(reflected(MetallicRoughness(Color{}, 1, 0.5), {0, 0, 1}) < 1e-3);
    CHECK(reflected(MetallicRoughness(Color{}, 0, 0.1), {0, 0, 1}) == Approx(0.04).epsilon(1e-2));
    std::mt19937_64 random(7);
    const MetallicRoughness black(Color{}, 1, 0.5);
    for (int i = 0; i < 1000; ++i)
        if (const auto sample = black.sample(kUp, {0, 0, 1}, random3(random))) CHECK(sample->weight.g < 0.5);
}

TEST_CASE("MetallicRoughness: what is out of range is refused", "[material][metallic-roughness]") {
    for (const double bad : {-0.1, 1.1, std::nan("")}) {
        CHECK_THROWS_WITH(MetallicRoughness(kWhite, bad, 0.5), Catch::Contains("metallic must"));
        CHECK_THROWS_WITH(MetallicRoughness(kWhite, 0.5, bad), Catch::Contains("roughness must"));
        CHECK_THROWS_AS(MetallicRoughness(Color{bad, 0, 0}, 0.5, 0.5), ArgumentError);
    }
    CHECK_THROWS_AS(MetallicRoughness(kWhite, 0, 0.5, 0.9), ArgumentError);
    CHECK_THROWS_AS(MetallicRoughness(kWhite, 0, 0.5, HUGE_VAL), ArgumentError);
    CHECK_THROWS_AS(MetallicRoughness(std::shared_ptr<const Texture>(), 0, 0.5), ArgumentError);
    CHECK_THROWS_AS(MetallicRoughness(solid(kWhite), std::shared_ptr<const Texture>()), ArgumentError);
}

}  // namespace limn::metallic_roughness_test
