// Lobes and the bases they stand on, at the ends of what numbers, normals, angles and indices can be.
#include "bsdf/fresnel-inl.h"
#include "hard/hard.h"
#include "limn/math/frame.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/lambertian.h"
#include "support/chi_square.h"
#include "support/random_geometry.h"
#include "support/real.h"

namespace limn::materials_test {

using namespace test;

TEST_CASE("Lambertian: every sample is a unit direction above the surface, whatever the normal and the numbers",
          "[hard][materials]") {
    // Numbers of few bits, which meet the borders of the maps, and normals near the poles, where bases break down.
    std::mt19937_64 random(69);
    const auto number = [&] {
        const double x = uniform(random);
        switch (random() % 4) {
            case 0: return std::ldexp(std::floor(std::ldexp(x, 3)), -3);
            case 1: return std::ldexp(x, -static_cast<int>(random() % 1000));
            case 2: return std::min(1 - std::ldexp(x, -static_cast<int>(random() % 60)), 1 - 0x1p-53);
            default: return x;
        }
    };
    const auto tilt = [&] {
        return (random() % 2 ? 1 : -1) * std::ldexp(uniform(random), -static_cast<int>(random() % 1080));
    };
    int wrong = 0, skew = 0, absorbed = 0;
    const int samples = count(1e8);
    const Lambertian white(Color{1, 1, 1});
    for (int i = 0; i < samples; ++i) {
        const double x = tilt(), y = tilt();
        const Vec3 n = normalize(Vec3{x, y, random() % 2 ? 1.0 : -1.0});
        const Frame f(n);
        const double off = std::max({std::abs(dot(f.x, f.y)), std::abs(dot(f.x, f.z)), std::abs(dot(f.y, f.z)),
                                     std::abs(length_squared(f.x) - 1), std::abs(length_squared(f.y) - 1)});
        skew += !(off <= 2 * 0x1p-52);
        Surface s;
        s.normal = s.shading_normal = Normal3(n);
        const double u = number(), v = number();
        const auto sample = white.sample(s, n, {u, v, 0});
        absorbed += !sample;  // at the horizon, where the density is 0
        if (sample && !(std::abs(length(sample->direction) - 1) <= gamma(32) && dot(sample->direction, n) > 0 &&
                        std::isfinite(sample->pdf) && sample->pdf > 0))
            ++wrong;
    }
    CHECK(wrong == 0);
    CHECK(skew == 0);
    CHECK(absorbed <= samples / 2);
}

namespace {

// Born and Wolf, section 1.5.2, in __float128.
Real reflectance(Real cos_i, Real eta) {
    const Real squared = 1 - (1 - cos_i * cos_i) / (eta * eta);
    if (eta == 1) return 0;
    if (!(squared > 0) || !(cos_i > 0)) return 1;
    const Real cos_t = square_root(squared);
    const Real s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t), p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    return (s * s + p * p) / 2;
}

}  // namespace

TEST_CASE("Dielectric: reflectance is Fresnel's to 1e-6, and with what is transmitted 1, up to every critical angle",
          "[hard][materials]") {
    Random random(67);
    double worst_reflected = 0, worst_sum = 0;
    int wrong = 0;
    for (int i = 0; i < count(1e8) / 4; ++i) {
        double eta = random.log_uniform(1e-3, 1e3);
        if (random.chance(0.1)) eta = 1 + random.sign() * std::ldexp(1.0, -static_cast<int>(random.index(53)));
        if (random.chance(0.1)) eta = random.chance(0.5) ? 1e-3 : 1e3;
        double c = random.uniform();
        const double critical = eta < 1 ? std::sqrt((1 - eta) * (1 + eta)) : 0;
        switch (random.index(6)) {
            case 0: c = critical + random.sign() * std::ldexp(critical, -static_cast<int>(random.index(54))); break;
            case 1: c = std::nextafter(critical, random.sign()); break;
            case 2: c = std::ldexp(1.0, -static_cast<int>(random.index(1075))); break;
            case 3: c = 1 - std::ldexp(1.0, -static_cast<int>(random.index(54))); break;
            case 4: c = random.chance(0.5) ? 1 + 0x1p-23 : 0.0; break;
            default: break;
        }
        const double inside = std::clamp(c, 0.0, 1.0), r = bsdf::HWY_NAMESPACE::reflectance_exact(c, eta),
                     cos_t = bsdf::HWY_NAMESPACE::cos_transmitted(inside, eta);
        // At the critical angle the curve is vertical: its value is one within a few roundings of the angle.
        Real least = 1, most = 0;
        for (const double by : {-0x1p-50, 0.0, 0x1p-50}) {
            const Real truth = reflectance(std::min(inside + by * inside, 1.0), eta);
            least = std::min(least, truth), most = std::max(most, truth);
        }
        worst_reflected =
            std::max({worst_reflected, static_cast<double>(Real(r) - most), static_cast<double>(least - Real(r))});
        wrong += !(r >= 0 && r <= 1 && cos_t >= 0 && cos_t <= 1);
        if (cos_t == 0 || inside == 0) continue;
        const double ts = 2 * inside / (inside + eta * cos_t), tp = 2 * inside / (eta * inside + cos_t);
        worst_sum = std::max(worst_sum, std::abs(r + eta * (cos_t / inside) * (ts * ts + tp * tp) / 2 - 1));
        const double schlick = bsdf::HWY_NAMESPACE::reflectance_schlick(c, eta);
        wrong += !(schlick >= 0 && schlick <= 1);
    }
    CHECK(wrong == 0);
    CHECK(worst_reflected <= 1e-6);
    CHECK(worst_sum <= 1e-6);
}

TEST_CASE("Dielectric: what is sampled has unit length and keeps to Snell's law, at every index and angle",
          "[hard][materials]") {
    Random random(68);
    int wrong = 0;
    double worst_law = 0;
    Surface s;
    s.normal = s.shading_normal = {0, 0, 1};
    for (int i = 0; i < count(1e8) / 4; ++i) {
        const double index = random.chance(0.1) ? 1 + random.sign() * 0x1p-52 : random.log_uniform(1e-3, 1e3);
        const double grazing =
            random.chance(0.5) ? random.uniform() : std::ldexp(random.uniform(), -static_cast<int>(random.index(300)));
        const double phi = random.uniform(0, 2 * kPi), sine = std::sqrt((1 - grazing) * (1 + grazing));
        const Vec3 out = normalize(Vec3{sine * std::cos(phi), sine * std::sin(phi), grazing});
        s.front_face = i % 2 == 0;
        const double pick = random.uniform();
        const Fresnel formula = random.chance(0.5) ? Fresnel::exact : Fresnel::schlick;
        const auto sample = Dielectric(index, formula).sample(s, out, {pick, 0.5, 0.5});
        if (!sample || !(std::abs(length(sample->direction) - 1) <= gamma(32)) || !(sample->weight == Color{1, 1, 1})) {
            ++wrong;
            continue;
        }
        const double eta = sample->direction.z > 0 ? 1 : s.front_face ? index : 1 / index;
        const Vec3 tangential = eta * Vec3{sample->direction.x, sample->direction.y, 0} + Vec3{out.x, out.y, 0};
        worst_law = std::max(worst_law, length(tangential) / std::max(1.0, eta));
    }
    CHECK(wrong == 0);
    CHECK(worst_law <= 1e-12);
}

}  // namespace limn::materials_test
