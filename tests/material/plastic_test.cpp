#include "limn/scene/material/plastic.h"

#include <cmath>

#include "catch.h"
#include "limn/limn.h"
#include "limn/math/error.h"
#include "material/lobe.h"
#include "material/microfacets.h"

namespace limn::plastic_test {

using namespace test;

namespace {

const Color kWhite{1, 1, 1};

}  // namespace

TEST_CASE("Plastic: samples follow the density, at every roughness, brushed and not", "[material][plastic]") {
    for (const Roughness& roughness : kGridBrushed) {
        CAPTURE(roughness.u, roughness.v);
        check_samples(Plastic(Color{.8, .4, .1}, roughness));
    }
}

TEST_CASE("Plastic: a white one loses no light, at any roughness, index and angle to 85 degrees",
          "[material][plastic]") {
    for (const double index : {1.0, 1.33, 1.5, 2.5})
        for (const double roughness : {0.1, 0.3, 0.6, 1.0})
            for (const double degrees : {0.0, 45.0, 70.0, 85.0}) {
                CAPTURE(index, roughness, degrees);
                const Plastic white(kWhite, roughness, index);
                CHECK(std::abs(reflected(white, at_angles(radians(degrees), 0.3)) - 1) < 1e-3);
            }
}

TEST_CASE("Plastic: a smooth one that absorbs nothing loses no light, and samples its mirror as often as it reflects",
          "[material][plastic]") {
    std::mt19937_64 random(5);
    const Plastic white(kWhite, 0), dark(Color{.3, .3, .3}, 0);
    for (const double degrees : {0.0, 45.0, 70.0, 85.0}) {
        CAPTURE(degrees);
        const Vec3 out = at_angles(radians(degrees), 0.3);
        double mirrored = 0;
        constexpr int kSamples = 20000;
        for (int i = 0; i < kSamples; ++i) {
            const auto sample = white.sample(kUp, out, random3(random));
            REQUIRE(sample);
            if (sample->pdf > 0) {
                CHECK(sample->weight.g == Approx(white.value(kUp, out, sample->direction).value.g / sample->pdf));
            } else {
                CHECK(length(sample->direction - Vec3{-out.x, -out.y, out.z}) < 1e-14);
                mirrored += sample->weight.g / kSamples;
            }
        }
        const double coat = fresnel(out.z, 1.5), deviation = std::sqrt(coat * (1 - coat) / kSamples);
        CHECK(std::abs(mirrored - coat) < 4 * deviation);
        CHECK(reflected(white, out) + coat == Approx(1).epsilon(1e-3));
        // The rest is in proportion to the albedo.
        CHECK(reflected(dark, out) == Approx(0.3 * reflected(white, out)));
    }
}

TEST_CASE("Plastic: its value is the coat's reflection plus the albedo of what the coat transmits, by integrals",
          "[material][plastic]") {
    const double alpha = 0.25, index = 1.6;
    // What the coat reflects, by integrals in numbers of their own.
    const auto once = [&](const Vec3& o, const Vec3& i) {
        const Vec3 m = normalize(o + i);
        const double masking = 1 / (1 + ggx_lambda(o, alpha, alpha) + ggx_lambda(i, alpha, alpha));
        return fresnel(std::min(dot(o, m), 1.0), index) * ggx_density(m, alpha, alpha) * masking / (4 * o.z);
    };
    const auto coat = [&](double cosine, int steps) {
        const Vec3 o = at_angles(std::acos(cosine), 0);
        return integral_of_directions(std::acos(cosine), kPi, kPi / 2, steps,
                                      [&](const Vec3& i) { return once(o, i); });
    };
    double mean = 0;
    for (int k = 0; k < 40; ++k) mean += 2 * (k + 0.5) / 40 * coat((k + 0.5) / 40, 60) / 40;
    const Color albedo{.2, .5, .9}, specular{1, .5, 0};
    const Plastic plastic(albedo, std::sqrt(alpha), index, specular);
    std::mt19937_64 random(3);
    for (int i = 0; i < 20; ++i) {
        const Vec3 out = random_out(random, kUp), in = random_out(random, kUp);
        if (std::min(out.z, in.z) < 0.05) continue;
        const double below = (1 - coat(out.z, 150)) * (1 - coat(in.z, 150)) / (1 - mean) * in.z / kPi;
        const Color expected = once(out, in) * specular + below * albedo, value = plastic.value(kUp, out, in).value;
        CHECK(value.r == Approx(expected.r).epsilon(1e-3));
        CHECK(value.g == Approx(expected.g).epsilon(1e-3));
        CHECK(value.b == Approx(expected.b).epsilon(1e-3));
    }
}

TEST_CASE("Plastic: of index 1 it is Lambertian, and light goes both ways alike", "[material][plastic]") {
    std::mt19937_64 random(25);
    const Color albedo{.2, .5, .8};
    const Plastic bare(albedo, 0.5, 1), rough(albedo, 0.5), smooth(albedo, 0), brushed(albedo, {0.3, 0.8});
    const Lambertian ideal(albedo);
    for (int i = 0; i < 1000; ++i) {
        Surface s = surface(random_direction(random));
        s.dp_du = random_direction(random);
        const Vec3 a = random_out(random, s), b = random_out(random, s);
        if (std::min(dot(a, s.normal), dot(b, s.normal)) < 1e-3) continue;
        CHECK(bare.value(s, a, b).value.g == Approx(ideal.value(s, a, b).value.g).epsilon(1e-9));
        for (const Plastic* p : {&rough, &smooth, &brushed})
            CHECK(p->value(s, a, b).value.g / dot(b, s.normal) ==
                  Approx(p->value(s, b, a).value.g / dot(a, s.normal)).epsilon(1e-7));
    }
}

TEST_CASE("Plastic: what is out of range is refused", "[material][plastic]") {
    for (const double bad : {-0.1, 1.1, std::nan("")}) {
        CHECK_THROWS_AS(Plastic(kWhite, bad), ArgumentError);
        CHECK_THROWS_AS(Plastic(Color{bad, 0, 0}, 0.5), ArgumentError);
        CHECK_THROWS_AS(Plastic(kWhite, 0.5, 1.5, Color{0, bad, 0}), ArgumentError);
    }
    CHECK_THROWS_AS(Plastic(kWhite, 0.5, 0.9), ArgumentError);
    CHECK_THROWS_AS(Plastic(kWhite, 0.5, HUGE_VAL), ArgumentError);
    CHECK_THROWS_AS(Plastic(std::shared_ptr<const Texture>(), 0.5), ArgumentError);
    CHECK_THROWS_AS(Plastic(std::make_shared<SolidColor>(kWhite), 0.5, 1.5, std::shared_ptr<const Texture>()),
                    ArgumentError);
}

}  // namespace limn::plastic_test
