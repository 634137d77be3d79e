// Light that media scatter once: where it is asked for, and that all of it is counted once.
#include "render/equiangular.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "property.h"
#include "render/single_ray.h"
#include "support/random_geometry.h"

namespace limn::equiangular_test {

using namespace test;
using transport::Equiangular;

namespace {

struct Case {
    Ray ray;
    transport::Stretch stretch{};
    Point3 pivot;
    double least_height = 0;

    Equiangular sampler() const { return {ray, stretch, pivot, least_height}; }
};

Case random_case(std::uint64_t seed) {
    Random random(seed);
    Case c;
    c.ray = {.origin = Point3{} + random.in_cube(3), .direction = random.log_uniform(0.1, 10) * random.unit()};
    const double unit = 1 / length(c.ray.direction);
    c.stretch.from = random.uniform(0, 3) * unit;
    c.stretch.to = c.stretch.from + random.log_uniform(0.01, 100) * unit;
    c.pivot = Point3{} + random.in_cube(3);
    c.least_height = random.chance(0.5) ? 0 : random.uniform(0, 2);
    return c;
}

Object fog_in(Object boundary, double density, const Color& albedo = {0.9, 0.9, 0.9}) {
    return std::make_shared<ConstantMedium>(std::move(boundary), density, albedo);
}

}  // namespace

TEST_CASE("Equiangular: a share u of the density lies before the sample of u", "[render][media]") {
    holds([](std::uint64_t seed) {
        const Case c = random_case(seed);
        const Equiangular along = c.sampler();
        const double u = Random(seed + 1).uniform(), speed = length(c.ray.direction);
        const double share = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
            [&](double t) { return along.pdf(t) * speed; }, c.stretch.from, along.sample(u), 20, 1e-10);
        RC_ASSERT(std::abs(share - u) <= 1e-8);
        RC_ASSERT(along.sample(0) >= c.stretch.from);
        RC_ASSERT(along.sample(1 - 0x1p-53) <= c.stretch.to);
    });
}

TEST_CASE("Equiangular: equal steps of u are equal angles as seen from the pivot", "[render][media]") {
    holds([](std::uint64_t seed) {
        Case c = random_case(seed);
        c.least_height = 0;
        const Equiangular along = c.sampler();
        const auto angle = [&](double t, double u) {
            const Vec3 a = c.ray.at(t) - c.pivot, b = c.ray.at(u) - c.pivot;
            return std::atan2(length(cross(a, b)), dot(a, b));
        };
        RC_ASSERT(std::abs(angle(c.stretch.from, c.stretch.to) - along.angle()) <= 1e-9);
        for (int i = 0; i < 4; ++i)
            RC_ASSERT(std::abs(angle(along.sample(i / 4.0), along.sample((i + 1) / 4.0)) - along.angle() / 4) <= 1e-9);
    });
}

TEST_CASE("Equiangular: fog around a tiny lamp is as bright as the integral along the ray says", "[render][media]") {
    // Of a ball of radius r at distance d the fog sees pi r^2 / d^2; the ray passes it at distance 0.3.
    constexpr double kRadius = 1e-3, kHeight = 0.3, kDensity = 0.2, kFog = 0.7, kEnd = 4;
    const Object tiny = sphere({0, 0, 0}, kRadius, lamp(1 / (kPi * kRadius * kRadius)));
    const CompiledScene scene = compile_with(
        sky(0),
        {tiny, fog_in(make_box({-kEnd, -kEnd, -kEnd}, {kEnd, kEnd, kEnd}, nullptr), kDensity, {kFog, kFog, kFog})});
    const double truth = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
        [&](double x) {
            const double d = std::hypot(x, kHeight);
            return kFog * kDensity / (4 * kPi) * std::exp(-kDensity * (x + kEnd + d)) / (d * d);
        },
        -kEnd, kEnd, 20, 1e-10);
    const Ray ray{.origin = {-6, kHeight, 0}, .direction = {2, 0, 0}};
    check_mean(along(scene, ray, 2, Estimator::path, 4000), truth, 4e-3);
}

}  // namespace limn::equiangular_test
