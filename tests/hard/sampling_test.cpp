// Samplers at the ends of their range, against their densities. Those of warps, lobes and lamps of ordinary shape are
// in tests/math, tests/material and tests/render.
#include <array>

#include "flat/scene.h"
#include "hard/hard.h"
#include "limn/math/frame.h"
#include "limn/scene/camera.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/texture/checker.h"
#include "limn/scene/texture/solid.h"
#include "render/media.h"
#include "render/sampler.h"
#include "support/chi_square.h"
#include "support/pictures.h"
#include "support/real.h"
#include "support/single_shading.h"

namespace limn::sampling_test {

using namespace test;
using transport::Sampler;

namespace {

const int kCount = count(1e7);

double turns(double y, double x) { return std::atan2(y, x) / (2 * kPi) + 0.5; }

// The place in the unit square of a direction that ought to be uniform in a cone around `axis`, 1 - cos of which is
// given.
std::pair<double, double> in_cone(const Vec3& direction, const Vec3& axis, double one_minus_cos) {
    const Vec3 local = Frame(axis).to_local(direction);
    return {(local.x * local.x + local.y * local.y) / (1 + local.z) / one_minus_cos, turns(local.y, local.x)};
}

std::optional<LightSample> draw(const CompiledScene& scene, const Point3& from, std::mt19937_64& random) {
    const double pick = uniform(random), u = uniform(random);
    return sample_light(scene.flat(), {from, {}}, 0, pick, u, uniform(random));
}

// A sphere at distance d: 1 - cos of the angle of its radius, in __float128.
Real one_minus_cos(double radius, const Vec3& to_center) {
    const Real r = radius, d2 = dot(Real3(to_center), Real3(to_center)), s2 = r * r / d2;
    return s2 / (1 + square_root(1 - s2));
}

const Real kRealPi = Real(3.14159265358979323846) + Real(1.2246467991473532e-16);

// Van Oosterom and Strackee, as in support/solid_angle.h; the products that cancel where a triangle is seen edge-on in
// __float128.
double triangle_angle(const Real3& a, const Real3& b, const Real3& c) {
    const Real la = length(a), lb = length(b), lc = length(c);
    const Real sine = absolute(dot(a, cross(b, c)));
    const Real cosine = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    return 2 * std::atan2(static_cast<double>(sine), static_cast<double>(cosine));
}
// The part of a rectangle between two fractions of each edge.
double rectangle_angle(const Point3& corner, const Vec3& u, const Vec3& v, const Point3& from, double u0 = 0,
                       double u1 = 1, double v0 = 0, double v1 = 1) {
    const Real3 p = Real3(corner) - Real3(from), e(u), f(v);
    const auto at = [&](double x, double y) { return p + Real(x) * e + Real(y) * f; };
    return triangle_angle(at(u0, v0), at(u1, v0), at(u0, v1)) + triangle_angle(at(u1, v0), at(u1, v1), at(u0, v1));
}

}  // namespace

TEST_CASE("Lens: its points are uniform at the smallest and the largest aperture", "[hard][sampling]") {
    for (const auto& [aperture, focus] : {std::pair{1e-3, 1e6}, {10.0, 1e-3}}) {
        Camera camera{.look_from = {0, 0, 0}, .look_at = {0, 0, -1}, .vertical_fov = 40};
        camera.aperture_angle = aperture, camera.focus_distance = focus;
        const CameraRays rays(camera, 64, 48);
        const double radius = focus * std::tan(radians(aperture) / 2);
        std::mt19937_64 random(60);
        CAPTURE(aperture, focus);
        CHECK(uniform_square_p(kCount, [&] {
                  const double u = uniform(random);
                  const Vec3 p = (rays.ray(3, 4, u, uniform(random), 0).origin - Point3{}) / radius;
                  return std::pair(p.x * p.x + p.y * p.y, turns(p.y, p.x));
              }) > kSamplerLevel);
    }
}

TEST_CASE("Sampler: the numbers of a pixel, of a sample and of a seed are uniform, two by two", "[hard][sampling]") {
    const auto pairs_p = [](const auto& sampler_of) {
        std::uint64_t i = 0;
        return uniform_square_p(kCount, [&] {
            const auto numbers = sampler_of(i++).numbers_of(0);
            return std::pair(numbers[0], numbers[1]);
        });
    };
    CHECK(pairs_p([](std::uint64_t i) { return Sampler(64, 7, i); }) > kSamplerLevel);
    CHECK(pairs_p([](std::uint64_t i) { return Sampler(64, i, 7); }) > kSamplerLevel);
    CHECK(pairs_p([](std::uint64_t i) { return Sampler(i, 7, 64); }) > kSamplerLevel);
}

TEST_CASE("Lamps: directions fill a sphere's cone from 1.5 to 1.5e7 radii away", "[hard][sampling]") {
    for (const double distance : {1.5, 1.5e2, 1.5e4, 1.5e7}) {
        const Point3 center{1, -2, 0.5};
        const CompiledScene scene = compile_with(sky(0), {sphere(center, 1, lamp(1))});
        const Vec3 axis = normalize(Vec3{1, 2, -3});
        const Point3 from = center - distance * axis;
        const double omc = static_cast<double>(one_minus_cos(1, center - from));
        std::mt19937_64 random(65);
        CAPTURE(distance);
        CHECK(uniform_square_p(kCount, [&] {
                  return in_cone(draw(scene, from, random)->direction, normalize(center - from), omc);
              }) > kSamplerLevel);
    }
}

TEST_CASE("Lamps: the density towards a sphere is right to 1e-12 from 1.0000001 to 1.5e7 radii away, at every size",
          "[hard][sampling]") {
    Random random(66);
    for (const double ratio : {1.0000001, 1.01, 1.5, 15.0, 1.5e2, 1.5e3, 1.5e4, 1.5e5, 1.5e6, 1.5e7})
        for (const double radius : {1e-4, 1.0, 3e5})
            for (int i = 0; i < 20; ++i) {
                const Point3 from = Point3{} + radius * random.in_cube(3);
                const Point3 center = from + ratio * radius * random.unit();
                const CompiledScene scene = compile_with(sky(0), {sphere(center, i % 2 ? radius : -radius, lamp(1))});
                // 1.0000001 radii away 1 - sin^2 keeps nine digits of what the distance is rounded to.
                const double truth = static_cast<double>(1 / (2 * kRealPi * one_minus_cos(radius, center - from)));
                const auto s = sample_light(scene.flat(), {from, {}}, 0, 0, random.uniform(), random.uniform());
                REQUIRE(s.has_value());
                CAPTURE(ratio, radius, s->pdf / truth - 1);
                CHECK(std::abs(s->pdf / truth - 1) <= (ratio < 1.001 ? 1e-9 : 1e-12));
                CHECK(pdf_light(scene.flat(), {from, {}}, 0, 0, s->point.position) == s->pdf);
            }
    // The catalogue's own: a unit sphere 1.5e4 away.
    const CompiledScene scene = compile_with(sky(0), {sphere({0, 0, 1.5e4}, 1, lamp(1))});
    CHECK(pdf_light(scene.flat(), {}, 0, 0, {}) == Approx(7.16197243118e7).epsilon(1e-11));
}

TEST_CASE("Lamps: a rectangle is sampled by its density, seen from its face, almost edge-on, and from far away",
          "[hard][sampling]") {
    const Point3 corner{-1, 2, -0.5};
    const Vec3 u{2, 0, 0}, v{0, 0, 1};
    // Not plain, so that the place on it is known.
    const auto grey_lamp = [](double radiance) {
        return std::make_shared<SolidColor>(Color{radiance, radiance, radiance});
    };
    const auto chequered = std::make_shared<DiffuseLight>(std::make_shared<Checker>(1, grey_lamp(1), grey_lamp(2)));
    const CompiledScene scene = compile_with(sky(0), {quad(corner, u, v, chequered)});
    // Edge-on from inside its outline and from outside; the last two so far away that it is sampled by area.
    for (const Point3& from : {Point3{0.2, 1, 0.1}, Point3{0.5, 2 - 1e-6, 0.1}, Point3{2.5, 2 + 1e-4, 0.3},
                               Point3{30, -100, 5}, Point3{500, -700, 20}}) {
        constexpr std::size_t kSide = 16;
        std::vector<double> observed(kSide * kSide), expected(kSide * kSide);
        std::mt19937_64 random(67);
        int missing = 0;
        for (int i = 0; i < kCount; ++i) {
            const auto s = draw(scene, from, random);
            if (!s) {
                ++missing;
                continue;
            }
            const auto cell = [](double x) { return std::min(static_cast<std::size_t>(x * kSide), kSide - 1); };
            observed[cell(s->point.uv.u) * kSide + cell(s->point.uv.v)] += 1;
        }
        double total = 0;
        for (std::size_t i = 0; i < observed.size(); ++i) {
            const double step = 1.0 / kSide, x = step * static_cast<double>(i / kSide),
                         y = step * static_cast<double>(i % kSide);
            total += expected[i] = rectangle_angle(corner, u, v, from, x, x + step, y, y + step);
        }
        if (length(from - corner) > 10) std::fill(expected.begin(), expected.end(), total / (kSide * kSide));
        for (double& e : expected) e *= kCount / total;
        CAPTURE(from.x, from.y, total);
        CHECK(missing == 0);
        CHECK(chi_square_p(observed, expected) > kSamplerLevel);
    }
}

TEST_CASE("Lamps: a rectangle's solid angle and the samples in it are right from 1e-9 to 1e3 sizes above its plane",
          "[hard][sampling]") {
    Random random(68);
    double worst_angle = 0, worst_sample = 0;
    for (int i = 0; i < count(2e6); ++i) {
        const Vec3 u{random.log_uniform(1e-3, 1e3), 0, 0}, v{0, random.log_uniform(1e-3, 1e3), 0};
        const Point3 from{random.uniform(-2, 3) * u.x, random.uniform(-2, 3) * v.y, random.log_uniform(1e-9, 1e3)};
        const double truth = rectangle_angle({}, u, v, from);
        if (truth < 1e-5) continue;  // sampled by area
        const SphericalRectangle rectangle({}, u, v, from);
        worst_angle = std::max(worst_angle, std::abs(rectangle.solid_angle() / truth - 1));
        const double share = random.uniform(0.01, 0.99);
        const Uv at = rectangle.sample(share, random.uniform());
        const double before = rectangle_angle({}, u, v, from, 0, at.u) / truth;
        // Close above it the samples crowd at the foot point: `at` is a fraction of the whole edge, in steps of 2^-53.
        const double resolution = 4 * 0x1p-53 * u.x / from.z;
        worst_sample = std::max(worst_sample, std::abs(before - share) - resolution);
    }
    // Angles of some pi, rounded, leave the solid angle; its square, from 1e-10 on, is what places samples are solved
    // from.
    CHECK(worst_angle <= 1e-9);
    CHECK(worst_sample <= 32 * kPi * 0x1p-53 / 1e-10);
}

TEST_CASE("Metal: the narrowest lobes follow their density too", "[hard][sampling]") {
    const double fuzz = 1e-4;
    const Vec3 out = normalize(Vec3{3, -1, 2}), mirrored{-out.x, -out.y, out.z};
    Surface s;
    s.normal = s.shading_normal = {0, 0, 1};
    const Metal metal({1, 1, 1}, fuzz);
    DirectionHistogram histogram(mirrored, std::asin(fuzz));
    std::mt19937_64 random(69);
    for (int i = 0; i < kCount; ++i) {
        const double x = uniform(random), y = uniform(random);
        histogram.add(metal.sample(s, out, {x, y, uniform(random)})->direction);
    }
    CHECK(histogram.p_value([&](const Vec3& in) { return metal.value(s, out, in).pdf; }) > kSamplerLevel);
}

namespace {

// The p-value of Kolmogorov and Smirnov for numbers in [0, 1) that ought to be uniform, to some 1e-6 of their count: a
// cell of the histogram. Series: Marsaglia, Tsang, Wang, Evaluating Kolmogorov's Distribution, 2003.
class KolmogorovSmirnov {
public:
    void add(double x) { ++cells_[std::min(static_cast<std::size_t>(x * kCells), kCells - 1)], ++count_; }
    double p_value() const {
        double below = 0, distance = 0;
        const double n = static_cast<double>(count_);
        for (std::size_t i = 0; i < kCells; ++i) {
            below += static_cast<double>(cells_[i]);
            distance = std::max(distance, std::abs(below / n - static_cast<double>(i + 1) / kCells));
        }
        const double x = distance * (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n));  // Stephens, 1970
        double p = 0;
        for (int k = 1; k < 100; ++k) p += (k % 2 ? 2 : -2) * std::exp(-2.0 * k * k * x * x);
        return std::min(p, 1.0);
    }

private:
    static constexpr std::size_t kCells = std::size_t{1} << 20;
    std::vector<std::uint32_t> cells_ = std::vector<std::uint32_t>(kCells);
    std::uint64_t count_ = 0;
};

}  // namespace

TEST_CASE("Media: free paths are exponential in mean and distribution, and so is their tail beyond 24 bits",
          "[hard][sampling]") {
    // One endless medium of extinction 2, at depth 0 from the start.
    const Object fog = std::make_shared<ConstantMedium>(sphere({0, 0, 0}, 1e6, nullptr), 2, Color{1, 1, 1});
    const CompiledScene scene = compile_with(sky(0), {fog});
    transport::MediaAlongRay media;
    media.trace(scene.flat(), {.origin = {0, 0, 0}, .direction = {0, 3, 0}});
    const int draws = count(1e8);
    KolmogorovSmirnov whole, tail;
    double sum = 0, tail_sum = 0;
    int missing = 0;
    for (int i = 0; i < draws; ++i) {
        const Sampler sampler(55, static_cast<std::uint64_t>(i), 0);
        const double u = sampler.numbers_of(0)[0], in_tail = 1 - std::ldexp(1 - sampler.numbers_of(1)[0], -24);
        const transport::FreeFlight path = media.sample(-std::log1p(-u), 0.5),
                                    far = media.sample(-std::log1p(-in_tail), 0.5);
        if (!path.scatters || !far.scatters) {
            ++missing;
            continue;
        }
        // Memoryless: beyond 24 log 2 = 16.64 mean paths the rest is distributed as the whole.
        const double depth = 6 * path.t, rest = 6 * far.t - 24 * std::log(2.0);
        sum += depth, tail_sum += rest;
        whole.add(-std::expm1(-depth)), tail.add(-std::expm1(-rest));
    }
    CHECK(missing == 0);
    const double n = draws, sigma = 1 / std::sqrt(n);  // of a mean of exponential numbers
    CHECK(std::abs(sum / n - 1) <= 4.5 * sigma);
    CHECK(std::abs(tail_sum / n - 1) <= 4.5 * sigma);
    CHECK(whole.p_value() > 1e-3);
    CHECK(tail.p_value() > 1e-3);
}

}  // namespace limn::sampling_test
