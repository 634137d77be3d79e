#include "limn/scene/material/oren_nayar.h"

#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <vector>

#include "catch.h"
#include "limn/limn.h"
#include "limn/math/error.h"
#include "material/lobe.h"

namespace limn::oren_nayar_test {

using namespace test;

namespace {

const Surface kUp = surface({0, 0, 1});

Vec3 at(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// f |cos| over all directions.
double reflected(const Material& material, const Vec3& out) {
    using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;
    const double outward = std::atan2(out.y, out.x);
    const auto ring = [&](double theta) {
        const auto value = [&](double phi) { return material.value(kUp, out, at(theta, outward + phi)).value.g; };
        // The lobe has a kink across the plane of the two directions.
        return 2 * std::sin(theta) *
               (Quadrature::integrate(value, 0, kPi / 2, 5, 1e-9) +
                Quadrature::integrate(value, kPi / 2, kPi, 5, 1e-9));
    };
    const double edge = std::acos(out.z);
    return Quadrature::integrate(ring, 0, edge, 5, 1e-9) + Quadrature::integrate(ring, edge, kPi / 2, 5, 1e-9);
}

}  // namespace

TEST_CASE("OrenNayar: samples follow the density, at every roughness", "[material][oren-nayar]") {
    for (const double roughness : kGridRoughness) {
        CAPTURE(roughness);
        check_samples(OrenNayar({1, .5, 1}, roughness));
    }
}

TEST_CASE("OrenNayar: facets that reflect all lose no light, at any roughness and angle", "[material][oren-nayar]") {
    for (const double roughness : {0.0, 0.1, 0.5, 1.0})
        for (const double degrees : {0.0, 20.0, 45.0, 70.0, 85.0, 89.5}) {
            CAPTURE(roughness, degrees);
            CHECK(reflected(OrenNayar({1, 1, 1}, roughness), at(radians(degrees), 0.3)) == Approx(1).epsilon(1e-5));
        }
}

TEST_CASE("OrenNayar: the single scattering is Fujii's form of the model, and the rest is what it loses",
          "[material][oren-nayar]") {
    // At albedo rho the value is rho S + M rho^2 / (1 - k rho): S by a small rho, as written in the paper.
    const double r = 0.6, a = 1 / (1 + (0.5 - 2 / (3 * kPi)) * r);
    const Vec3 out = at(0.9, 0), in = at(0.6, 0.4);
    const double across = dot(in, out) - in.z * out.z;
    const double single = in.z / kPi * a * (1 + r * across / std::max(in.z, out.z));
    const double rho = 1e-9;
    CHECK(OrenNayar({rho, rho, rho}, r).value(kUp, out, in).value.g / rho == Approx(single).epsilon(1e-7));
    // Darker albedos lose more than in proportion.
    const auto share = [&](double albedo) {
        return OrenNayar({albedo, albedo, albedo}, r).value(kUp, out, in).value.g / albedo;
    };
    CHECK(share(0.2) < share(0.5));
    CHECK(share(0.5) < share(1));
}

TEST_CASE("OrenNayar: roughness 0 is Lambertian, and light goes both ways alike", "[material][oren-nayar]") {
    std::mt19937_64 random(25);
    const Color albedo{.2, .5, .8};
    const OrenNayar smooth(albedo, 0), rough(albedo, 0.8);
    const Lambertian ideal(albedo);
    for (int i = 0; i < 1000; ++i) {
        const Surface s = surface(random_direction(random));
        const Vec3 a = random_out(random, s), b = random_out(random, s);
        CHECK(smooth.value(s, a, b).value.g == Approx(ideal.value(s, a, b).value.g).epsilon(1e-14));
        CHECK(rough.value(s, a, b).value.g / dot(b, s.normal) ==
              Approx(rough.value(s, b, a).value.g / dot(a, s.normal)).epsilon(1e-10));
    }
}

TEST_CASE("OrenNayar: a roughness or albedo outside [0, 1] is refused", "[material][oren-nayar]") {
    for (const double bad : {-0.1, 1.1, std::nan("")}) {
        CHECK_THROWS_AS(OrenNayar(Color{.5, .5, .5}, bad), ArgumentError);
        CHECK_THROWS_AS(OrenNayar(Color{bad, 0, 0}, 0.5), ArgumentError);
    }
    CHECK_THROWS_AS(OrenNayar(std::shared_ptr<const Texture>(), 0.5), ArgumentError);
}

}  // namespace limn::oren_nayar_test
