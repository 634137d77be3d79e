// Statistics of the noise behind figures 7, 8 and 12, over many random lattices.
#include <cmath>
#include <numbers>
#include <random>

#include "catch.h"
#include "support.h"

namespace limn::test_marble {

using namespace test;

namespace {

constexpr int kLattices = 200, kPoints = 2000;

// For each lattice f(lattice, points), where the points fill the period of the lattice at scale 1, 256, rounded up to
// whole stripes of the marble.
template <class F>
Estimate over_lattices(const F& f) {
    std::mt19937_64 engine(7);
    std::uniform_real_distribution<double> coordinate(0, 82 * std::numbers::pi);
    std::vector<double> values;
    for (std::uint64_t seed = 0; seed < kLattices; ++seed) {
        const auto lattice = std::make_shared<PerlinLattice>(PerlinLattice::from_seed(seed));
        std::vector<Surface> points(kPoints);
        for (Surface& s : points) s.position = {coordinate(engine), coordinate(engine), coordinate(engine)};
        values.push_back(f(lattice, points));
    }
    return estimate(values);
}

double noise_at(const Noise& noise, const Surface& s) { return 2 * noise.value(s).r - 1; }

// Mean over the points of g(value of the texture).
template <class Value, class G>
double mean_of(const std::vector<Surface>& points, const Value& value, const G& g) {
    double sum = 0;
    for (const Surface& s : points) sum += g(value(s));
    return sum / static_cast<double>(points.size());
}

}  // namespace

TEST_CASE("Noise over 200 lattices: mean 0, deviation .182, kurtosis 2.63, 0 at lattice points", "[figures]") {
    const auto moment = [](int power) {
        return over_lattices([power](const auto& lattice, const auto& points) {
            const Noise noise(1, lattice);
            return mean_of(
                points, [&](const Surface& s) { return noise_at(noise, s); },
                [&](double n) { return std::pow(n, power); });
        });
    };
    const Estimate second = moment(2), fourth = moment(4);
    CAPTURE(second.mean, second.error, fourth.mean, fourth.error);
    CHECK(agrees(moment(1), 0));
    CHECK(agrees(second, .182 * .182, 2 * .182 * .0005));
    const double variance = second.mean * second.mean;
    // First order in the errors of both moments, taken as if they did not cancel.
    const double error = fourth.error / variance + 2 * fourth.mean / variance * second.error / second.mean;
    CHECK(agrees({fourth.mean / variance, error}, 2.63, .005));

    const Noise noise(1, 3);
    for (const Point3 p : {Point3{0, 0, 0}, {3, 200, 255}, {-5, 17, 1000}}) CHECK(noise.value(surface_at(p)).r == .5);
}

TEST_CASE("Turbulence over 200 lattices: mean .170, deviation .125", "[figures]") {
    const auto moment = [](int power) {
        return over_lattices([power](const auto& lattice, const auto& points) {
            const Turbulence turbulence(1, lattice);
            return mean_of(
                points, [&](const Surface& s) { return turbulence.value(s).g; },
                [&](double n) { return std::pow(n, power); });
        });
    };
    const Estimate first = moment(1), second = moment(2);
    CAPTURE(first.mean, first.error, second.mean, second.error);
    CHECK(agrees(first, .170, .0005));
    CHECK(agrees(second, .170 * .170 + .125 * .125, 2 * (.170 + .125) * .0005));
}

TEST_CASE("Marble over 200 lattices follows the law of a sine's values", "[figures]") {
    for (int i = 0; i < 10; ++i) {
        const double low = i / 10.0, high = (i + 1) / 10.0;
        const Estimate share = over_lattices([&](const auto& lattice, const auto& points) {
            const Marble marble(1, lattice);
            return mean_of(
                points, [&](const Surface& s) { return marble.value(s).b; },
                [&](double m) { return m >= low && m < high; });
        });
        // The distribution of (1 + sin(uniform phase)) / 2.
        const double truth = 2 / std::numbers::pi * (std::asin(std::sqrt(high)) - std::asin(std::sqrt(low)));
        CAPTURE(i, share.mean, share.error, truth);
        CHECK(agrees(share, truth));
    }
}

TEST_CASE("Marble's stripes advance along z with period 2 pi / scale", "[figures]") {
    // Without turbulence: all gradients zero.
    const Marble marble(4, std::make_shared<PerlinLattice>());
    const double period = 2 * std::numbers::pi / 4;
    CHECK(close(period, 1.571, .0005));
    for (double z = -3; z < 3; z += .1) {
        const auto value = [&](double x, double y, double at) { return marble.value(surface_at({x, y, at})).r; };
        CHECK(close(value(0, 0, z), .5 * (1 + std::sin(4 * z)), 1e-15));
        CHECK(close(value(5, -7, z + period), value(0, 0, z), 1e-14));
    }
}

TEST_CASE("Different seeds give different marble, equal seeds the same", "[figures]") {
    const Marble a(4, 1), b(4, 2), c(4, 1);
    const Surface s = surface_at({.3, .4, .5});
    CHECK(a.value(s) != b.value(s));
    CHECK(a.value(s) == c.value(s));
}

}  // namespace limn::test_marble
