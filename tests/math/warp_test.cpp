#include "limn/math/warp.h"

#include <cmath>
#include <random>
#include <utility>

#include "catch.h"
#include "limn/math/math.h"
#include "property.h"
#include "support/chi_square.h"
#include "support/grid.h"

namespace limn::warp_test {

using test::chi_square_p;
using test::DirectionHistogram;
using test::kDraws;
using test::kSamplerLevel;
using test::uniform;

namespace {

constexpr double kAlmostOne = 1 - 0x1p-53;
constexpr double kCorners[] = {0, 0x1p-1074, 0x1p-53, 0.25, 0.5 - 0x1p-54, 0.5, 0.5 + 0x1p-53, 0.75, kAlmostOne};

template <class Sample, class Pdf>
double direction_p(const Sample& sample, const Pdf& pdf) {
    std::mt19937_64 random(64);
    DirectionHistogram histogram({0, 0, 1});
    for (int i = 0; i < kDraws; ++i) {
        const double u = uniform(random);
        histogram.add(sample(u, uniform(random)));
    }
    return histogram.p_value(pdf);
}

}  // namespace

TEST_CASE("Warp: the cosine hemisphere follows its density", "[core][warp]") {
    CHECK(direction_p(sample_cosine_hemisphere, [](const Vec3& w) { return pdf_cosine_hemisphere(w.z); }) >
          kSamplerLevel);
}

TEST_CASE("Warp: the uniform sphere follows its density", "[core][warp]") {
    CHECK(direction_p(sample_uniform_sphere, [](const Vec3&) { return pdf_uniform_sphere(); }) > kSamplerLevel);
}

TEST_CASE("Warp: uniform cones follow their density, wide and narrow", "[core][warp]") {
    for (const double one_minus_cos : {1e-9, 0.25, 1.0, 2.0}) {
        std::mt19937_64 random(65);
        CAPTURE(one_minus_cos);
        CHECK(test::uniform_square_p(kDraws, [&] {
                  const double u = uniform(random);
                  const Vec3 w = sample_uniform_cone(u, uniform(random), one_minus_cos);
                  const double from_axis = (w.x * w.x + w.y * w.y) / (1 + w.z);  // 1 - cos without cancellation
                  return std::pair(w.z > -1 + 1e-9 ? from_axis / one_minus_cos : 1.0,
                                   std::atan2(w.y, w.x) / (2 * kPi) + 0.5);
              }) > kSamplerLevel);
        CHECK(pdf_uniform_cone(one_minus_cos) * 2 * kPi * one_minus_cos == Approx(1).epsilon(1e-15));
    }
}

TEST_CASE("Warp: the cone's density stays right for a light far away", "[core][warp]") {
    // A unit sphere at 1.5e4: 1 - cos = s^2 / (1 + cos), s = 1 / 1.5e4.
    const double s2 = 1 / (1.5e4 * 1.5e4);
    CHECK(pdf_uniform_cone(s2 / (1 + std::sqrt(1 - s2))) == Approx(7.16197243118e7).epsilon(1e-11));
}

TEST_CASE("Warp: the disc is uniform per area", "[core][warp]") {
    std::mt19937_64 random(66);
    CHECK(test::uniform_square_p(kDraws, [&] {
              const double u = uniform(random);
              const Vec3 p = sample_uniform_disc(u, uniform(random));
              return std::pair(length_squared(p), std::atan2(p.y, p.x) / (2 * kPi) + 0.5);
          }) > kSamplerLevel);
}

TEST_CASE("Warp: neighbours in the square are neighbours in the disc", "[core][warp]") {
    std::mt19937_64 random(70);
    constexpr double kStep = 1e-6;
    double farthest = 0;
    for (int i = 0; i < 100'000; ++i) {
        const double u = uniform(random), v = i % 3 == 0 ? u : i % 3 == 1 ? 1 - u : uniform(random);  // diagonals too
        const double du = kStep * (2 * uniform(random) - 1), dv = kStep * (2 * uniform(random) - 1);
        farthest = std::max(farthest, length(sample_uniform_disc(u + du, v + dv) - sample_uniform_disc(u, v)));
    }
    // Twice the square's stretch: radius and angle grow by 2 and pi / 2 a unit at most.
    CHECK(farthest <= kStep * std::sqrt(2.0) * (2 + kPi / 2));
}

TEST_CASE("Warp: the ball is uniform per volume", "[core][warp]") {
    std::mt19937_64 random(67);
    std::vector<double> observed(16 * 16 * 16);
    const auto index = [](double x) { return static_cast<std::size_t>(std::clamp(x * 16, 0.0, 15.0)); };
    for (int i = 0; i < kDraws; ++i) {
        const double u = uniform(random), v = uniform(random);
        const Vec3 p = sample_uniform_ball(u, v, uniform(random));
        const double r = length(p);  // r^3, cos theta and phi are independent and uniform
        observed[(index(r * r * r) * 16 + index((p.z / r + 1) / 2)) * 16 +
                 index(std::atan2(p.y, p.x) / (2 * kPi) + 0.5)] += 1;
    }
    CHECK(chi_square_p(observed, std::vector<double>(observed.size(), kDraws / 4096.0)) > kSamplerLevel);
}

TEST_CASE("Warp: the triangle is uniform per area", "[core][warp]") {
    std::mt19937_64 random(68);
    CHECK(test::uniform_square_p(kDraws, [&] {
              const double u = uniform(random);
              const Uv b = sample_uniform_triangle(u, uniform(random));
              const double far_side = b.u + b.v;  // distance from the first vertex; the area within it is its square
              return std::pair(far_side * far_side, b.v / far_side);
          }) > kSamplerLevel);
}

TEST_CASE("Warp: free flight follows its density", "[core][warp]") {
    const double sigma = 2.5, width = 0.05;
    std::mt19937_64 random(69);
    std::vector<double> observed(200), expected(200);
    for (int i = 0; i < kDraws; ++i)
        observed[static_cast<std::size_t>(std::min(sample_exponential(uniform(random), sigma) / width, 199.0))] += 1;
    double total = 0;
    for (std::size_t i = 0; i + 1 < expected.size(); ++i) {
        const double a = static_cast<double>(i) * width;
        const double simpson =
            pdf_exponential(a, sigma) + 4 * pdf_exponential(a + width / 2, sigma) + pdf_exponential(a + width, sigma);
        total += expected[i] = kDraws * simpson * width / 6;
    }
    expected.back() = kDraws - total;
    CHECK(chi_square_p(observed, expected) > kSamplerLevel);
}

TEST_CASE("Warp: free flight has no end that 24-bit numbers would set", "[core][warp]") {
    CHECK(sample_exponential(kAlmostOne, 1) == Approx(53 * std::log(2.0)));
    CHECK(sample_exponential(0x1p-60, 2) == 0x1p-61);
    CHECK(sample_exponential(0, 1) == 0);
    CHECK(sample_exponential(0.5, 0) == kInfinity);
    CHECK(pdf_exponential(-1, 2) == 0);
}

TEST_CASE("Warp: directions are unit and points inside, in every corner of the unit cube", "[core][warp]") {
    const double unit = gamma(16), inside = 1 + gamma(16);
    for (const double u : kCorners)
        for (const double v : kCorners) {
            CAPTURE(u, v);
            CHECK(std::abs(length(sample_cosine_hemisphere(u, v)) - 1) <= unit);
            CHECK(sample_cosine_hemisphere(u, v).z >= 0);
            CHECK(std::abs(length(sample_uniform_sphere(u, v)) - 1) <= unit);
            CHECK(length(sample_uniform_disc(u, v)) <= inside);
            CHECK(sample_uniform_disc(u, v).z == 0);
            for (const double w : kCorners) CHECK(length(sample_uniform_ball(u, v, w)) <= inside);
            for (const double omc : {1e-300, 1e-15, 0.5, 2.0})
                CHECK(std::abs(length(sample_uniform_cone(u, v, omc)) - 1) <= unit);
            const Uv b = sample_uniform_triangle(u, v);
            CHECK((b.u >= 0 && b.v >= 0 && b.u + b.v <= 1));
        }
}

TEST_CASE("Warp: one number sets the height and one the angle, so that samples spread well stay well spread",
          "[core][warp]") {
    const auto turns = [](const Vec3& w) {
        const double turn = std::atan2(w.y, w.x) / (2 * kPi);
        return turn < 0 ? turn + 1 : turn;
    };
    test::holds(
        [&] {
            const double u = 0.001 + 0.998 * test::draw_unit(), v = 0.001 + 0.998 * test::draw_unit(),
                         w = test::draw_unit();
            const Vec3 sphere = sample_uniform_sphere(u, v);
            RC_ASSERT((std::abs(sphere.z - (1 - 2 * u)) <= 1e-15 && std::abs(turns(sphere) - v) <= 1e-15));
            const Vec3 cone = sample_uniform_cone(u, v, 0.25);
            RC_ASSERT((std::abs(cone.z - (1 - 0.25 * u)) <= 1e-15 && std::abs(turns(cone) - v) <= 1e-15));
            RC_ASSERT(length(sample_uniform_ball(u, v, w) - std::cbrt(w) * sphere) <= 1e-15);
            // The hemisphere stands over the disc, and the disc's rings are the square's.
            const Vec3 disc = sample_uniform_disc(u, v), raised = sample_cosine_hemisphere(u, v);
            RC_ASSERT((raised.x == disc.x && raised.y == disc.y && raised.z > 0));
            RC_ASSERT(std::abs(length(disc) - std::max(std::abs(2 * u - 1), std::abs(2 * v - 1))) <= 1e-15);
            RC_ASSERT((disc.x * (2 * u - 1) >= 0 && disc.y * (2 * v - 1) >= 0));
            // Swapping the numbers swaps the axes of the disc and the weights of the triangle.
            const Vec3 swapped = sample_uniform_disc(v, u);
            RC_ASSERT(length(Vec3{swapped.y, swapped.x, 0} - disc) <= 1e-15);
            const Uv a = sample_uniform_triangle(u, v), b = sample_uniform_triangle(v, u);
            RC_ASSERT((a.u == b.v && a.v == b.u));
            RC_ASSERT(std::abs(pdf_exponential(sample_exponential(u, 3), 3) - 3 * (1 - u)) <= 1e-14);
        },
        1000);
}

TEST_CASE("Warp: below the horizon the cosine density is zero", "[core][warp]") {
    CHECK(pdf_cosine_hemisphere(-0.5) == 0);
    CHECK(pdf_cosine_hemisphere(1) == Approx(1 / kPi));
}

}  // namespace limn::warp_test
