#include "limn/scene/material/rough_conductor.h"

#include <cmath>

#include "bsdf/albedo_table.h"
#include "catch.h"
#include "limn/limn.h"
#include "limn/math/error.h"
#include "material/lobe.h"
#include "material/microfacets.h"

namespace limn::rough_conductor_test {

using namespace test;

namespace {

const Color kWhite{1, 1, 1};

// Copper at 650, 550 and 450 nm (Johnson and Christy, Optical Constants of the Noble Metals, 1972).
const ComplexIndex kCopper{{0.21, 1.03, 1.15}, {3.67, 2.60, 2.40}};

// What of white facets' light is scattered once: the integral over the sphere of directions, in numbers of its own.
double scattered_once(double ax, double ay, const Vec3& out) {
    const double theta = std::acos(out.z), phi = std::atan2(out.y, out.x) + kPi;
    return integral_of_directions(theta, phi, kPi / 2, 200, [&](const Vec3& in) {
        const Vec3 m = normalize(in + out);
        return ggx_density(m, ax, ay) / (1 + ggx_lambda(out, ax, ay) + ggx_lambda(in, ax, ay)) / (4 * out.z);
    });
}

}  // namespace

TEST_CASE("RoughConductor: samples follow the density, at every roughness, brushed and not",
          "[material][rough-conductor]") {
    for (const Roughness& roughness : kGridBrushed) {
        CAPTURE(roughness.u, roughness.v);
        check_samples(RoughConductor(Color{1, .5, 1}, roughness));
    }
}

TEST_CASE("RoughConductor: one that reflects all loses no light, at any roughness and angle to 85 degrees",
          "[material][rough-conductor]") {
    for (const double roughness : {0.05, 0.1, 0.2, 0.33, 0.5, 0.75, 0.9, 1.0})
        for (const double degrees : {0.0, 20.0, 45.0, 70.0, 80.0, 85.0}) {
            CAPTURE(roughness, degrees);
            CHECK(std::abs(reflected(RoughConductor(kWhite, roughness), at_angles(radians(degrees), 0.3)) - 1) < 1e-3);
        }
}

TEST_CASE("RoughConductor: a brushed one that reflects all loses no light, at any azimuth",
          "[material][rough-conductor]") {
    Surface s = kUp;
    s.dp_du = {1, 0, 0};
    for (const Roughness& roughness : {Roughness{0.1, 0.4}, {0.2, 0.9}, {1, 0.5}, {0.4, 0.6}})
        for (const double degrees : {0.0, 45.0, 70.0, 85.0})
            for (const double azimuth : {0.0, 10.0, 50.0, 90.0, 140.0}) {
                if (degrees == 0 && azimuth > 0) continue;
                CAPTURE(roughness.u, roughness.v, degrees, azimuth);
                const Vec3 out = at_angles(radians(degrees), radians(azimuth));
                const double all = reflected(RoughConductor(kWhite, roughness), out, s, 150);
                CHECK(std::abs(all - 1) < 1e-3);
            }
}

TEST_CASE("RoughConductor: the tables hold what facets scatter once", "[material][rough-conductor]") {
    for (const double roughness : {0.1, 0.4, 0.8, 1.0})
        for (const double degrees : {5.0, 40.0, 75.0, 85.0}) {
            CAPTURE(roughness, degrees);
            const double alpha = roughness * roughness, cosine = std::cos(radians(degrees));
            const double once = scattered_once(alpha, alpha, at_angles(radians(degrees), 0));
            CHECK(std::abs(bsdf::albedo_of(alpha, alpha, 0).at(0, cosine) - once) < 3e-4);
            CHECK(std::abs(bsdf::albedo_by_roughness(0).at(roughness, cosine) - once) < 5e-4);
        }
    const bsdf::AlbedoTable brushed = bsdf::albedo_of(0.05, 0.4, 0);
    for (const double azimuth : {0.0, 20.0, 70.0, 90.0}) {
        const Vec3 out = at_angles(1.2, radians(azimuth));
        CHECK(std::abs(brushed.at(azimuth / 90, out.z) - scattered_once(0.05, 0.4, out)) < 5e-4);
    }
}

TEST_CASE("RoughConductor: without multiple scattering it is the reference written out",
          "[material][rough-conductor]") {
    Surface s = kUp;
    s.dp_du = {0, 3, 0};
    const double along = 0.5, across = 0.8, ax = along * along, ay = across * across;
    const RoughConductor copper(kCopper, {along, across}), white(kWhite, {along, across});
    const bsdf::AlbedoTable table = bsdf::albedo_of(ax, ay, 0);
    std::mt19937_64 random(3);
    for (int i = 0; i < 200; ++i) {
        const Vec3 out = random_out(random, s), in = random_out(random, s);
        // x of the reference is along dp_du.
        const Vec3 o{out.y, -out.x, out.z}, w{in.y, -in.x, in.z}, m = normalize(o + w);
        const double once = ggx_density(m, ax, ay) / (1 + ggx_lambda(o, ax, ay) + ggx_lambda(w, ax, ay)) / (4 * o.z);
        const auto azimuth = [](const Vec3& v) { return std::atan2(std::abs(v.y), std::abs(v.x)) / (kPi / 2); };
        const double lost_out = 1 - table.at(azimuth(o), o.z), lost_in = 1 - table.at(azimuth(w), w.z);
        const double often = lost_out * lost_in / (kPi * (1 - table.mean_at(0))) * w.z;
        if (out.z < 1e-3) continue;  // where the horizon is kept clear of
        CHECK(white.value(s, out, in).value.g == Approx(once + often).epsilon(1e-9));
        const std::complex<double> index{kCopper.eta.r, kCopper.k.r};
        double mean = 0;
        for (int k = 0; k < 1000; ++k) mean += 2 * (k + 0.5) / 1000 * fresnel((k + 0.5) / 1000, index) / 1000;
        const double e = table.mean_at(0), again = mean * mean * e / (1 - mean * (1 - e));
        CHECK(copper.value(s, out, in).value.r ==
              Approx(fresnel(dot(o, m), index) * once + again * often).epsilon(1e-4));
    }
}

TEST_CASE("RoughConductor: an index and the reflectance and edge tint of it are the same metal",
          "[material][rough-conductor]") {
    for (const std::complex<double> index :
         {std::complex<double>{0.05, 4.5}, {0.2, 3.7}, {1.0, 2.6}, {1.5, 0.0}, {0.7, 0.0}, {3.0, 3.3}, {9.0, 20.0}}) {
        const double eta = index.real(), k = index.imag();
        const RoughConductor mirror(ComplexIndex{{eta, eta, eta}, {k, k, k}}, 0);
        for (const double cosine : {1.0, 0.7, 0.3, 0.05, 0.001}) {
            CAPTURE(index, cosine);
            const Vec3 out = at_angles(std::acos(cosine), 1);
            const auto sample = mirror.sample(kUp, out, {.5, .5, .5});
            REQUIRE(sample);
            CHECK(sample->weight.g == Approx(fresnel(cosine, index)).epsilon(1e-9));
            CHECK(sample->pdf == 0);
            CHECK(length(sample->direction - Vec3{-out.x, -out.y, out.z}) < 1e-14);
            CHECK(mirror.value(kUp, out, sample->direction).pdf == 0);
        }
    }
    // The reflectance is that at normal incidence.
    for (const double tint : {0.0, 0.5, 1.0})
        for (const double reflectance : {0.0, 0.04, 0.5, 0.95, 1.0}) {
            const RoughConductor metal({reflectance, 1, 1}, 0, {tint, tint, tint});
            const auto sample = metal.sample(kUp, {0, 0, 1}, {.5, .5, .5});
            CHECK(sample->weight.r == Approx(reflectance).margin(1e-12));
        }
}

TEST_CASE("RoughConductor: light goes both ways alike", "[material][rough-conductor]") {
    std::mt19937_64 random(25);
    for (const Roughness& roughness : {Roughness{0.2}, {1.0}, {0.3, 0.7}}) {
        const RoughConductor copper(kCopper, roughness);
        for (int i = 0; i < 1000; ++i) {
            Surface s = surface(random_direction(random));
            s.dp_du = random_direction(random);
            const Vec3 a = random_out(random, s), b = random_out(random, s);
            if (std::min(dot(a, s.normal), dot(b, s.normal)) < 1e-3) continue;
            CHECK(copper.value(s, a, b).value.g / dot(b, s.normal) ==
                  Approx(copper.value(s, b, a).value.g / dot(a, s.normal)).epsilon(1e-6));
        }
    }
}

TEST_CASE("RoughConductor: brushed along dp_du, it stretches a highlight across", "[material][rough-conductor]") {
    Surface s = kUp;
    s.dp_du = {1, 0, 0};
    const RoughConductor brushed(kWhite, {0.2, 0.7});
    const Vec3 out{0, 0, 1};
    CHECK(brushed.value(s, out, at_angles(0.5, kPi / 2)).value.g >
          10 * brushed.value(s, out, at_angles(0.5, 0)).value.g);
    // On a user-defined shape, which has no dp_du, it is as bright in all.
    s.dp_du = {};
    CHECK(reflected(brushed, out) == Approx(1).epsilon(1e-3));
}

TEST_CASE("RoughConductor: a picture shows which way it is brushed", "[material][rough-conductor]") {
    // A small lamp mirrored in a square whose u runs along x, and in one whose u runs along y.
    const auto brightness = [](const Vec3& u, const Vec3& v) {
        Scene scene;
        const auto metal = std::make_shared<RoughConductor>(kWhite, Roughness{0.2, 0.7});
        scene.add(std::make_shared<Quad>(Point3{-1, -1, 0}, u, v, metal));
        scene.add(std::make_shared<Sphere>(Point3{4, 0, 6}, 0.5, std::make_shared<DiffuseLight>(Color{9, 9, 9})));
        const Camera camera{.look_from = {0, 0, 9}, .look_at = {0, 0, 0}, .vertical_fov = 1};
        const RenderSettings settings{.width = 8, .height = 8, .samples_per_pixel = 16};
        const Image image = render(compile(scene), camera, settings).image;
        double sum = 0;
        for (const float x : image.values()) sum += x;
        return sum;
    };
    CHECK(brightness({0, 2, 0}, {2, 0, 0}) > 5 * brightness({2, 0, 0}, {0, 2, 0}));
}

TEST_CASE("RoughConductor: what is out of range is refused", "[material][rough-conductor]") {
    for (const double bad : {-0.1, 1.1, std::nan("")}) {
        CHECK_THROWS_AS(RoughConductor(Color{.5, .5, .5}, bad), ArgumentError);
        CHECK_THROWS_AS(RoughConductor(Color{.5, .5, .5}, Roughness(0.5, bad)), ArgumentError);
        CHECK_THROWS_AS(RoughConductor(Color{bad, 0, 0}, 0.5), ArgumentError);
        CHECK_THROWS_AS(RoughConductor(Color{.5, .5, .5}, 0.5, Color{0, bad, 0}), ArgumentError);
    }
    CHECK_THROWS_AS(RoughConductor(std::shared_ptr<const Texture>(), 0.5), ArgumentError);
    CHECK_THROWS_AS(RoughConductor(ComplexIndex{{0, 1, 1}, {}}, 0.5), ArgumentError);
    CHECK_THROWS_AS(RoughConductor(ComplexIndex{{1, 1, 1}, {-1, 0, 0}}, 0.5), ArgumentError);
}

}  // namespace limn::rough_conductor_test
