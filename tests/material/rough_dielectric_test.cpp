#include "limn/scene/material/rough_dielectric.h"

#include <cmath>

#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/material/dielectric.h"
#include "material/lobe.h"
#include "material/microfacets.h"

namespace limn::rough_dielectric_test {

using namespace test;

namespace {

Surface side(bool front, const Vec3& normal = {0, 0, 1}) {
    Surface s = surface(normal);
    s.front_face = front;
    return s;
}

// f |cos| as Walter et al. write it (equations 20 and 21, of radiance that is not scaled by the square of the indices),
// with the correlated masking of light that is reflected. From index 1 to eta.
double written_out(double eta, double ax, double ay, const Vec3& o, const Vec3& i) {
    const double lambda_o = ggx_lambda(o, ax, ay), lambda_i = ggx_lambda(i, ax, ay);
    if (i.z > 0) {
        const Vec3 m = normalize(o + i);
        return fresnel(dot(o, m), eta) * ggx_density(m, ax, ay) / (1 + lambda_o + lambda_i) / (4 * o.z);
    }
    Vec3 m = -normalize(o + eta * i);
    if (m.z < 0) m = -m;
    const double cos_o = dot(o, m), cos_i = dot(i, m);
    if (!(cos_o > 0 && cos_i < 0)) return 0;
    const double path = cos_o + eta * cos_i;
    return cos_o * -cos_i / o.z * eta * eta * (1 - fresnel(cos_o, eta)) * ggx_density(m, ax, ay) /
           ((1 + lambda_o) * (1 + lambda_i) * path * path);
}

// Over both sides.
double scattered(const Material& material, const Surface& s, const Vec3& out, double eta) {
    const double theta = std::acos(out.z), phi = std::atan2(out.y, out.x) + kPi;
    const double sine = std::sin(theta) / eta, refracted = kPi - std::asin(std::min(sine, 1.0));
    const auto value = [&](const Vec3& in) { return material.value(s, out, in).value.g; };
    return reflected(material, out, s) +
           integral_of_directions(refracted, phi, kPi, 150, [&](const Vec3& in) { return in.z < 0 ? value(in) : 0; });
}

// What of a material goes to one side: at the horizon between them the density is not continuous.
class OneSide final : public Material {
public:
    OneSide(const Material& all, bool reflected) : all_(all), reflected_(reflected) {}
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override {
        const auto sample = all_.sample(s, out, random);
        return sample && is_mine(s, sample->direction) ? sample : std::nullopt;
    }
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override {
        return is_mine(s, in) ? all_.value(s, out, in) : ScatterValue{};
    }

private:
    bool is_mine(const Surface& s, const Vec3& in) const { return (dot(in, s.normal) > 0) == reflected_; }

    const Material& all_;
    bool reflected_;
};

}  // namespace

TEST_CASE("RoughDielectric: samples follow the density, from both sides, brushed and not",
          "[material][rough-dielectric]") {
    for (const bool front : {true, false})
        for (const Roughness& roughness : {Roughness{0.3}, {0.6}, {1.0}, {0.3, 0.5}}) {
            CAPTURE(front, roughness.u, roughness.v);
            const Surface s = grid_surface(front);
            const Vec3 up(s.normal);
            const RoughDielectric glass(1.5, roughness);
            check_samples(OneSide(glass, true));
            for (const double degrees : kGridDegrees) {
                CAPTURE(degrees);
                // By Snell's law; what facets still let through beyond total reflection leaves along the surface.
                const double sine = std::min(std::sin(radians(degrees)) * (front ? 1 / 1.5 : 1.5), 0.98);
                const Vec3 refracted = over(s, 180 - std::asin(sine) * 180 / kPi, 1 + kPi);
                check_samples(OneSide(glass, false), s, over(s, degrees), -up, refracted);
            }
        }
}

TEST_CASE("RoughDielectric: it is the reference written out", "[material][rough-dielectric]") {
    Surface front = side(true), back = side(false);
    front.dp_du = back.dp_du = {1, 0, 0};
    std::mt19937_64 random(8);
    for (const double index : {1.5, 0.7, 2.4})
        for (int k = 0; k < 500; ++k) {
            const RoughDielectric glass(index, {0.6, 0.9});
            const Vec3 out = random_out(random, front), in = random_direction(random);
            if (out.z < 1e-3) continue;
            const double expected = written_out(index, 0.36, 0.81, out, in);
            CHECK(glass.value(front, out, in).value.g == Approx(expected).epsilon(1e-8));
            CHECK(glass.value(back, out, in).value.g ==
                  Approx(written_out(1 / index, 0.36, 0.81, out, in)).epsilon(1e-8));
        }
}

TEST_CASE("RoughDielectric: of roughness 0 it is the smooth one, bit for bit", "[material][rough-dielectric]") {
    std::mt19937_64 random(2);
    const RoughDielectric rough(1.5, 0);
    const Dielectric smooth(1.5);
    RecordSink sink;
    CHECK(rough.lower(sink).lobe == smooth.lower(sink).lobe);
    for (int i = 0; i < 1000; ++i) {
        const Surface s = side(i % 2 == 0, random_direction(random));
        const Vec3 out = random_out(random, s);
        const Random3 numbers = random3(random);
        const auto a = rough.sample(s, out, numbers), b = smooth.sample(s, out, numbers);
        REQUIRE(a.has_value() == b.has_value());
        if (a) CHECK((a->direction == b->direction && a->weight == b->weight && a->pdf == b->pdf));
        CHECK(rough.value(s, out, a ? a->direction : out).pdf == 0);
    }
}

TEST_CASE("RoughDielectric: almost smooth it loses no light, and at any roughness it makes none",
          "[material][rough-dielectric]") {
    const auto of = [](double roughness, double degrees, bool front) {
        return scattered(RoughDielectric(1.5, roughness), side(front), at_angles(radians(degrees), 0.4),
                         front ? 1.5 : 1 / 1.5);
    };
    for (const bool front : {true, false})
        for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
            CAPTURE(front, degrees);
            CHECK(of(0.1, degrees, front) == Approx(1).epsilon(3e-3));
            for (const double roughness : {0.3, 0.5, 1.0}) CHECK(of(roughness, degrees, front) < 1);
        }
    // What the class states.
    CHECK(of(0.3, 0, true) == Approx(0.999).margin(1e-3));
    CHECK(of(0.5, 0, true) == Approx(0.992).margin(1e-3));
    CHECK(of(1, 0, true) == Approx(0.893).margin(1e-3));
    CHECK(of(1, 0, false) == Approx(0.417).margin(1e-3));
}

TEST_CASE("RoughDielectric: light goes both ways alike, but for the squares of the indices",
          "[material][rough-dielectric]") {
    std::mt19937_64 random(25);
    const RoughDielectric glass(1.5, {0.5, 0.8});
    for (int i = 0; i < 1000; ++i) {
        Surface front = surface(random_direction(random));
        front.dp_du = random_direction(random);
        Surface back = front;
        back.front_face = false;
        back.normal = back.shading_normal = -front.normal;
        const Vec3 a = random_out(random, front), b = random_direction(random);
        const double cos_a = dot(a, front.normal), cos_b = dot(b, front.normal);
        if (std::min(cos_a, std::abs(cos_b)) < 1e-3) continue;
        const bool reflects = cos_b > 0;
        const double there = glass.value(front, a, b).value.g / std::abs(cos_b);
        const double back_again = glass.value(reflects ? front : back, b, a).value.g / cos_a;
        CHECK(there == Approx(back_again * (reflects ? 1 : 1.5 * 1.5)).epsilon(1e-7));
    }
}

TEST_CASE("RoughDielectric: what is out of range is refused", "[material][rough-dielectric]") {
    for (const double bad : {-0.1, 1.1, std::nan("")}) CHECK_THROWS_AS(RoughDielectric(1.5, bad), ArgumentError);
    for (const double bad : {-1.0, 0.0, HUGE_VAL}) CHECK_THROWS_AS(RoughDielectric(bad, 0.5), ArgumentError);
}

}  // namespace limn::rough_dielectric_test
