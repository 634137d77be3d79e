#include "limn/scene/material/dielectric.h"

#include <cmath>

#include "bsdf/fresnel-inl.h"
#include "catch.h"
#include "limn/math/error.h"
#include "material/lobe.h"

namespace limn::dielectric_test {

using namespace test;

namespace {

double cos_transmitted(double c, double eta) { return bsdf::HWY_NAMESPACE::cos_transmitted(c, eta); }
double reflectance_exact(double c, double eta) { return bsdf::HWY_NAMESPACE::reflectance_exact(c, eta); }
double reflectance_schlick(double c, double eta) { return bsdf::HWY_NAMESPACE::reflectance_schlick(c, eta); }

Surface interface(bool front_face) {
    Surface s = surface({0, 0, 1});
    s.front_face = front_face;
    return s;
}

double cosine(double degrees) { return std::cos(radians(degrees)); }
Vec3 from_z(double degrees) { return {std::sin(radians(degrees)), 0, cosine(degrees)}; }

constexpr Random3 kReflect{0, 0, 0}, kRefract{kAlmostOne, 0, 0};

}  // namespace

TEST_CASE("Dielectric: reflectances are those of the reference table, exact and by Schlick", "[material][dielectric]") {
    struct Row {
        double eta, degrees, exact, schlick;
    };
    for (const Row& row : {Row{1.5, 0, .0400, .0400}, Row{1.5, 45, .0502, .0421}, Row{1.5, 60, .0892, .0700},
                           Row{1.5, 75, .2531, .2547}, Row{1.5, 85, .6128, .6485}, Row{1 / 1.5, 30, .0552, .0400},
                           Row{1 / 1.5, 38, .1422, .0404}, Row{1 / 1.5, 41.9, 1, 1}, Row{1 / 1.5, 90, 1, 1}}) {
        CAPTURE(row.eta, row.degrees);
        CHECK(std::abs(reflectance_exact(cosine(row.degrees), row.eta) - row.exact) <= .5e-4);
        CHECK(std::abs(reflectance_schlick(cosine(row.degrees), row.eta) - row.schlick) <= .5e-4);
    }
    CHECK(std::abs(reflectance_exact(cosine(41), 1 / 1.5) - .380) <= .5e-3);
    CHECK(std::abs(reflectance_schlick(cosine(41), 1 / 1.5) - .0409) <= .5e-4);
}

TEST_CASE("Dielectric: the mean reflectance of diffuse light is that of the reference table",
          "[material][dielectric]") {
    constexpr int kSteps = 100'000;
    double exact = 0, schlick = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double c = (i + .5) / kSteps;
        exact += 2 * c * reflectance_exact(c, 1.5) / kSteps;
        schlick += 2 * c * reflectance_schlick(c, 1.5) / kSteps;
    }
    CHECK(std::abs(exact - .0918) <= .5e-4);
    CHECK(std::abs(schlick - .0857) <= .5e-4);
}

TEST_CASE("Dielectric: reflected and transmitted flux are the incident flux", "[material][dielectric]") {
    std::mt19937_64 random(67);
    for (int i = 0; i < 100'000; ++i) {
        const double eta = std::exp(std::uniform_real_distribution<double>(-3, 3)(random));
        const double ci = uniform(random), ct = cos_transmitted(ci, eta);
        // Fresnel's amplitudes of the transmitted wave, whose beam is cos_t / cos_i as wide in a medium of index eta.
        const double ts = 2 * ci / (ci + eta * ct), tp = 2 * ci / (eta * ci + ct);
        const double transmitted = eta * ct / ci * (ts * ts + tp * tp) / 2;
        const double sum = reflectance_exact(ci, eta) + transmitted;
        if (!(std::abs(sum - 1) <= gamma(32))) FAIL(sum << " at " << ci << ' ' << eta);
    }
}

TEST_CASE("Dielectric: the cosine of the refracted direction is Snell's, in higher precision too",
          "[material][dielectric]") {
    std::mt19937_64 random(68);
    for (int i = 0; i < 100'000; ++i) {
        const double eta = std::exp(std::uniform_real_distribution<double>(-3, 3)(random));
        const double ci = uniform(random);
        const long double n = eta, c = ci, truth = 1 - (1 - c * c) / (n * n);
        const double squared = cos_transmitted(ci, eta) * cos_transmitted(ci, eta);
        // Both terms of the numerator are rounded a few times before they may cancel.
        const double allowed = gamma(8) * (std::abs(eta * eta - 1) + ci * ci) / (eta * eta);
        if (!(std::abs(squared - static_cast<double>(std::max(truth, 0.0L))) <= allowed)) FAIL(ci << ' ' << eta);
    }
}

TEST_CASE("Dielectric: the reflectance is the same from both sides of a refracted path", "[material][dielectric]") {
    for (const double degrees : {0.0, 20.0, 56.309932, 80.0}) {
        const double inside = cos_transmitted(cosine(degrees), 1.5);
        CHECK(reflectance_exact(cosine(degrees), 1.5) == Approx(reflectance_exact(inside, 1 / 1.5)).epsilon(1e-12));
    }
}

TEST_CASE("Dielectric: reflectances stay between 0 and 1 at the edges of their domain", "[material][dielectric]") {
    std::vector<double> cosines{1, 1 + 0x1p-23, 0, -1e-9, 1e-300, 1e-9, kAlmostOne};
    for (const double eta : {1 / 1.5, 1e-3, .999999}) {  // around the critical angle
        const double critical = std::sqrt(1 - eta * eta);
        cosines.insert(cosines.end(), {critical, std::nextafter(critical, 0), std::nextafter(critical, 1)});
    }
    for (const double eta : {1.0, 1 + 0x1p-52, 1 - 0x1p-53, 1.5, 1 / 1.5, 1e-3, 1e3, 1e-200, 1e200, 1e-310, kInfinity})
        for (const double c : cosines) {
            CAPTURE(eta, c);
            const double exact = reflectance_exact(c, eta), schlick = reflectance_schlick(c, eta);
            CHECK((exact >= 0 && exact <= 1));
            CHECK((schlick >= 0 && schlick <= 1));
        }
}

TEST_CASE("Dielectric: an index of 1 is not there", "[material][dielectric]") {
    for (const double c : {0.0, 1e-300, 1e-9, .5, 1.0}) CHECK(reflectance_exact(c, 1) == 0);
    const Dielectric air(1);
    std::mt19937_64 random(3);
    for (const bool front : {true, false})
        for (int i = 0; i < 1000; ++i) {
            const Vec3 out = i == 0 ? Vec3{1, 0, 1e-200} : random_out(random, interface(front));
            const auto sample = air.sample(interface(front), out, kReflect);
            REQUIRE(sample);
            CHECK(length(sample->direction + out) <= gamma(16));
        }
}

TEST_CASE("Dielectric: refraction obeys Snell's law on both sides and in the plane of incidence",
          "[material][dielectric]") {
    std::mt19937_64 random(4);
    const double index = 1.7;
    const Dielectric glass(index);
    for (int i = 0; i < 10'000; ++i) {
        const Surface s = interface(i % 2 == 0);
        const double eta = s.front_face ? index : 1 / index;
        const Vec3 out = random_out(random, s);
        const double sin_i = std::hypot(out.x, out.y);
        if (sin_i / eta > .999) continue;
        const auto sample = glass.sample(s, out, kRefract);
        REQUIRE(sample);
        const Vec3 in = sample->direction;
        CHECK(in.z < 0);
        CHECK(std::hypot(in.x, in.y) * eta == Approx(sin_i).epsilon(1e-12));
        CHECK(std::abs(in.x * out.y - in.y * out.x) <= 1e-15);
        CHECK(in.x * out.x + in.y * out.y <= 0);
        CHECK(sample->weight == Color{1, 1, 1});
        CHECK(sample->pdf == 0);

        // The way back leads to where the light came from.
        Surface back = surface({0, 0, -1});
        back.front_face = !s.front_face;
        const auto returned = glass.sample(back, in, kRefract);
        REQUIRE(returned);
        CHECK(length(returned->direction - out) <= 1e-12 / std::abs(in.z));
    }
}

TEST_CASE("Dielectric: reflects as often as the reflectance says", "[material][dielectric]") {
    for (const Fresnel fresnel : {Fresnel::exact, Fresnel::schlick})
        for (const bool front : {true, false})
            for (const double degrees : {0.0, 20.0, 40.0, 50.0, 85.0}) {
                const double eta = front ? 1.5 : 1 / 1.5;
                const double r = fresnel == Fresnel::exact ? reflectance_exact(cosine(degrees), eta)
                                                           : reflectance_schlick(cosine(degrees), eta);
                const Dielectric glass(1.5, fresnel);
                CAPTURE(front, degrees, r);
                const auto below = glass.sample(interface(front), from_z(degrees), {r * (1 - 1e-12), .5, .5});
                REQUIRE(below);
                CHECK(length(below->direction - from_z(-degrees)) <= gamma(8));
                const auto above =
                    glass.sample(interface(front), from_z(degrees), {std::min(r * (1 + 1e-12), kAlmostOne), .5, .5});
                REQUIRE(above);
                CHECK((above->direction.z > 0) == (r == 1));
            }
}

TEST_CASE("Dielectric: nothing is lost, and directions are unit, at any index and angle", "[material][dielectric]") {
    std::mt19937_64 random(67);
    for (const Fresnel fresnel : {Fresnel::exact, Fresnel::schlick})
        for (const double index : {1e-300, 1e-3, 1 / 1.5, 1.0, 1 + 0x1p-52, 1.5, 1e3, 1e300}) {
            const Dielectric glass(index, fresnel);
            int violations = 0;
            for (int i = 0; i < 50'000; ++i) {
                const Surface s = interface(i % 2 == 0);
                const auto sample = glass.sample(s, random_out(random, s), random3(random));
                if (!(sample && is_unit(sample->direction) && sample->weight == Color{1, 1, 1})) ++violations;
            }
            CAPTURE(index);
            CHECK(violations == 0);
        }
}

TEST_CASE("Dielectric: with a shading normal no direction ends on the wrong side", "[material][dielectric]") {
    std::mt19937_64 random(5);
    const Dielectric glass(1.5);
    for (int i = 0; i < 100'000; ++i) {
        const Surface s = surface(random_direction(random), random_direction(random));
        const Vec3 out = random_out(random, s);
        const double r = reflectance_exact(dot(out, s.shading_normal), 1.5);
        const Random3 u = random3(random);
        const auto sample = glass.sample(s, out, u);
        if (sample && (dot(sample->direction, s.normal) >= 0) != (u.x < r)) FAIL("wrong side");
    }
}

TEST_CASE("Dielectric: impossible indices are refused", "[material][dielectric]") {
    for (const double index : {0.0, -1.5, std::nan(""), kInfinity}) CHECK_THROWS_AS(Dielectric(index), ArgumentError);
}

}  // namespace limn::dielectric_test
