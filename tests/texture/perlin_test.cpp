#include "limn/scene/texture/perlin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "bsdf/perlin.h"
#include "catch.h"
#include "limn/math/error.h"
#include "limn/math/math.h"

namespace limn::perlin_test {

using pattern::marble;
using pattern::noise;
using pattern::turbulence;

namespace {

const double kNaN = std::nan("");

Point3 random_point(std::mt19937_64& random, double size) {
    std::uniform_real_distribution<double> coordinate(-size, size);
    const double x = coordinate(random), y = coordinate(random);
    return {x, y, coordinate(random)};
}

// A number measured on each of many lattices: its mean and the standard error of that.
struct Measured {
    double sum = 0, squares = 0, count = 0;
    void add(double x) { sum += x, squares += x * x, ++count; }
    double mean() const { return sum / count; }
    double error() const { return std::sqrt((squares / count - mean() * mean()) / (count - 1)); }
    // Returns true if the mean is the published number, which is rounded to `digits` decimals and was measured on 200
    // lattices, of another program.
    bool agrees(double published, int digits) const {
        CAPTURE(mean(), error(), published);
        return std::abs(mean() - published) <= 0.5 * std::pow(10, -digits) + 4 * std::sqrt(2.0) * error();
    }
};

// Mean, standard deviation and kurtosis of `pattern` over random points, on each of 200 lattices.
struct Moments {
    Measured mean, deviation, kurtosis;
    double largest = 0, smallest = kInfinity;
    std::array<Measured, 10> deciles;

    template <class Pattern>
    explicit Moments(const Pattern& pattern) {
        std::mt19937_64 random(75);
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            const PerlinLattice lattice = PerlinLattice::from_seed(seed);
            constexpr int kPoints = 2000;
            std::array<double, kPoints> values;
            for (double& v : values) v = pattern(lattice, random_point(random, 128));
            double average = 0, second = 0, fourth = 0;
            for (const double v : values) average += v / kPoints;
            for (const double v : values) {
                const double d2 = (v - average) * (v - average);
                second += d2 / kPoints;
                fourth += d2 * d2 / kPoints;
            }
            mean.add(average);
            deviation.add(std::sqrt(second));
            kurtosis.add(fourth / (second * second));
            const auto [low, high] = std::minmax_element(values.begin(), values.end());
            smallest = std::min(smallest, *low);
            largest = std::max(largest, *high);
            std::array<double, 10> shares{};
            for (const double v : values)
                shares[static_cast<std::size_t>(std::clamp(v * 10, 0.0, 9.0))] += 1.0 / kPoints;
            for (std::size_t i = 0; i < 10; ++i) deciles[i].add(shares[i]);
        }
    }
};

}  // namespace

TEST_CASE("PerlinLattice: unit gradients and true permutations", "[core][perlin]") {
    for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{7}, ~std::uint64_t{0}}) {
        const PerlinLattice lattice = PerlinLattice::from_seed(seed);
        for (const Vec3& g : lattice.gradients) CHECK(std::abs(length(g) - 1) <= gamma(8));
        for (auto p : {lattice.perm_x, lattice.perm_y, lattice.perm_z}) {
            std::sort(p.begin(), p.end());
            for (std::size_t i = 0; i < 256; ++i) CHECK(p[i] == i);
        }
        CHECK(lattice.perm_x != lattice.perm_y);
        CHECK(lattice.perm_y != lattice.perm_z);
    }
}

TEST_CASE("PerlinLattice: the seed decides every bit", "[core][perlin]") {
    CHECK(PerlinLattice::from_seed(7) == PerlinLattice::from_seed(7));
    CHECK_FALSE(PerlinLattice::from_seed(7) == PerlinLattice::from_seed(8));
    // The first three published outputs of SplitMix64 for this seed.
    const auto from_bits = [](std::uint64_t x) { return static_cast<double>(x >> 11) * 0x1p-52 - 1; };
    const Vec3 first{from_bits(6457827717110365317u), from_bits(3203168211198807973u), from_bits(9817491932198370423u)};
    CHECK(PerlinLattice::from_seed(1234567).gradients[0] == normalize(first));
}

TEST_CASE("PerlinLattice: a permutation keeps one entry in place on average, as random ones do", "[core][perlin]") {
    Measured fixed;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const PerlinLattice lattice = PerlinLattice::from_seed(seed);
        for (const auto& p : {lattice.perm_x, lattice.perm_y, lattice.perm_z}) {
            int in_place = 0;
            for (std::size_t i = 0; i < 256; ++i) in_place += p[i] == i;
            fixed.add(in_place);
        }
    }
    CHECK(std::abs(fixed.mean() - 1) < 4 / std::sqrt(3000.0));  // a Poisson number, so its variance is 1 too
}

TEST_CASE("Perlin noise: exactly zero at lattice points", "[texture][perlin]") {
    const PerlinLattice lattice = PerlinLattice::from_seed(1);
    for (const double x : {0.0, -0.0, 1.0, -1.0, 255.0, 256.0, -257.0, 1e6, 0x1p53, 1e20, -1e38, 1e308})
        for (const double y : {0.0, 3.0, -4.0, 1e9})
            for (const double z : {0.0, -7.0, 1e12}) CHECK(noise(lattice, {x, y, z}) == 0);
}

TEST_CASE("Perlin noise: its slope at a lattice point is the gradient that the permutations name",
          "[texture][perlin]") {
    const PerlinLattice lattice = PerlinLattice::from_seed(2);
    constexpr double kStep = 0x1p-20;  // the next term of the series is 3 kStep
    for (int x = -300; x <= 300; x += 37)
        for (int y = -300; y <= 300; y += 41)
            for (int z = -300; z <= 300; z += 43) {
                const auto byte = [](int i) { return static_cast<std::size_t>(i & 255); };
                const auto index = lattice.perm_x[byte(x)] ^ lattice.perm_y[byte(y)] ^ lattice.perm_z[byte(z)];
                const Vec3 gradient = lattice.gradients[static_cast<std::size_t>(index)];
                const double px = x, py = y, pz = z;
                const Vec3 slope = Vec3{noise(lattice, {px + kStep, py, pz}), noise(lattice, {px, py + kStep, pz}),
                                        noise(lattice, {px, py, pz + kStep})} /
                                   kStep;
                if (!(length(slope - gradient) <= 8 * kStep)) FAIL("at " << x << ' ' << y << ' ' << z);
            }
}

TEST_CASE("Perlin noise: with equal gradients along x it is t - (3 t^2 - 2 t^3)", "[texture][perlin]") {
    PerlinLattice lattice = PerlinLattice::from_seed(3);
    lattice.gradients.fill({1, 0, 0});
    std::mt19937_64 random(3);
    for (int i = 0; i < 1000; ++i) {
        const Point3 p = random_point(random, 100);
        const double t = p.x - std::floor(p.x);
        CHECK(noise(lattice, p) == Approx(t - t * t * (3 - 2 * t)).margin(1e-14));
    }
}

TEST_CASE("Perlin noise: continuous across the walls of cells, where the lattice begins again too",
          "[texture][perlin]") {
    const PerlinLattice lattice = PerlinLattice::from_seed(10);
    constexpr double kStep = 0x1p-30;
    for (const double wall : {-512.0, -256.0, -255.0, -1.0, 0.0, 1.0, 255.0, 256.0, 512.0})
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Point3 before{.3, .6, .45}, after = before;
            before[axis] = wall - kStep, after[axis] = wall + kStep;
            CAPTURE(wall, axis);
            CHECK(std::abs(noise(lattice, before) - noise(lattice, after)) <= 8 * kStep);
        }
}

TEST_CASE("Perlin noise: repeats every 256 cells", "[texture][perlin]") {
    const PerlinLattice lattice = PerlinLattice::from_seed(4);
    for (const double x : {-3.75, 0.5, 77.125, 255.0625}) {
        const double here = noise(lattice, {x, 0.25, -1.5});
        CHECK(here != 0);
        CHECK(noise(lattice, {x + 256, 0.25, -1.5}) == here);
        CHECK(noise(lattice, {x, 0.25 - 512, -1.5 + 0x1p40}) == here);
    }
}

TEST_CASE("Perlin noise: within its bound near and far", "[texture][perlin]") {
    const PerlinLattice lattice = PerlinLattice::from_seed(5);
    std::mt19937_64 random(5);
    // Under the eight weights the squared distance to a corner has mean 3/4 at most, so |noise| <= sqrt(3/4).
    const double bound = std::sqrt(0.75) + 1e-15;
    double largest = 0;
    for (const double size : {1.0, 1e6, 1e9, 1e15, 1e38})
        for (int i = 0; i < 50'000; ++i)
            largest = std::max(largest, std::abs(noise(lattice, random_point(random, size))));
    CHECK(largest <= bound);
    CHECK(largest > 0.5);
}

TEST_CASE("Perlin textures: finite wherever they are asked", "[texture][perlin]") {
    const PerlinLattice lattice = PerlinLattice::from_seed(6);
    for (const double x : {-1e-30, 1e9, -1e15, 1e38, 1e300, 1.7e308, kInfinity, -kInfinity, kNaN})
        for (const Point3& p : {Point3{x, .5, .5}, Point3{.5, .5, x}, Point3{x, x, x}}) {
            CHECK(std::abs(noise(lattice, p)) <= 1);
            CHECK((turbulence(lattice, p) >= 0 && turbulence(lattice, p) < 2));
            CHECK((marble(lattice, 4, p) >= 0 && marble(lattice, 4, p) <= 1));
        }
    CHECK(marble(lattice, 4, {0, 0, kInfinity}) == 0.5);  // the middle, where there is no phase
}

TEST_CASE("Perlin noise: its mean, standard deviation and kurtosis are the published ones", "[texture][perlin]") {
    const Moments m(noise);
    CHECK(m.mean.agrees(0, 3));
    CHECK(m.deviation.agrees(.182, 3));
    CHECK(m.kurtosis.agrees(2.63, 2));
}

TEST_CASE("Perlin turbulence: its mean and standard deviation are the published ones, and it is at least 0 and below 1",
          "[texture][perlin]") {
    const Moments m(turbulence);
    CHECK(m.mean.agrees(.170, 3));
    CHECK(m.deviation.agrees(.125, 3));
    CHECK(m.smallest >= 0);
    CHECK(m.largest < 1);
}

TEST_CASE(
    "Perlin marble: its mean, standard deviation and deciles are those of a sine with uniform phase, as published",
    "[texture][perlin]") {
    const Moments m([](const PerlinLattice& lattice, const Point3& p) { return marble(lattice, 4, p); });
    CHECK(m.mean.agrees(.499, 3));
    CHECK(m.deviation.agrees(.354, 3));
    constexpr double kShares[] = {.205, .091, .074, .067, .064, .064, .067, .074, .091, .205};
    for (std::size_t i = 0; i < 10; ++i) CHECK(m.deciles[i].agrees(kShares[i], 3));
}

TEST_CASE("Perlin turbulence: the absolute value of seven octaves' sum", "[texture][perlin]") {
    const PerlinLattice lattice = PerlinLattice::from_seed(9);
    std::mt19937_64 random(9);
    for (int i = 0; i < 1000; ++i) {
        const Point3 p = random_point(random, 10);
        double sum = 0;
        for (int k = 0; k < 7; ++k) {
            const double f = std::ldexp(1.0, k);
            sum += noise(lattice, {f * p.x, f * p.y, f * p.z}) / f;
        }
        CHECK(turbulence(lattice, p) == Approx(std::abs(sum)).margin(1e-15));
    }
}

TEST_CASE("Perlin textures: scaled, coloured values of their patterns", "[texture][perlin]") {
    const auto lattice = std::make_shared<const PerlinLattice>(PerlinLattice::from_seed(7));
    const Color color{.9, .5, .1};
    Surface s;
    s.position = {.3, 1.7, -2.2};
    const Point3 scaled{4 * .3, 4 * 1.7, 4 * -2.2};
    CHECK(Noise(4, lattice, color).value(s) == color * ((1 + noise(*lattice, scaled)) / 2));
    CHECK(Turbulence(4, lattice, color).value(s) == color * turbulence(*lattice, scaled));
    CHECK(Marble(4, lattice, color).value(s) ==
          color * ((1 + std::sin(scaled.z + 10 * turbulence(*lattice, scaled))) / 2));
    CHECK(Marble(4, 7, color).value(s) == Marble(4, lattice, color).value(s));
    CHECK_FALSE(Marble(4, 8, color).value(s) == Marble(4, lattice, color).value(s));
}

TEMPLATE_TEST_CASE("Perlin textures: white with the lattice of their seed, unless told otherwise", "[texture][perlin]",
                   Noise, Turbulence, Marble) {
    const auto lattice = std::make_shared<const PerlinLattice>(PerlinLattice::from_seed(7));
    const Color white{1, 1, 1}, color{.9, .5, .1};
    Surface s;
    s.position = {.3, 1.7, -2.2};
    const Color value = TestType(4, lattice, white).value(s);
    CHECK(max_component(value) > 0);
    CHECK(TestType(4, lattice).value(s) == value);
    CHECK(TestType(4, 7).value(s) == value);
    CHECK(TestType(4, 7, color).value(s) == color * value);
    CHECK_FALSE(TestType(4, 8).value(s) == value);
    CHECK_FALSE(TestType(5, 7).value(s) == value);
}

TEMPLATE_TEST_CASE("Perlin textures: impossible arguments are refused", "[texture][perlin]", Noise, Turbulence,
                   Marble) {
    for (const double scale : {kNaN, kInfinity, -kInfinity}) CHECK_THROWS_AS(TestType(scale, 1), ArgumentError);
    CHECK_THROWS_AS(TestType(1, std::shared_ptr<const PerlinLattice>()), ArgumentError);
    CHECK_THROWS_AS(TestType(1, 1, Color{-1, 0, 0}), ArgumentError);
    CHECK_NOTHROW(TestType(-2, 1));
}

}  // namespace limn::perlin_test
