#include "limn/scene/texture/checker.h"

#include <cmath>
#include <cstdint>
#include <random>

#include "bsdf/checker.h"
#include "catch.h"
#include "limn/math/error.h"
#include "limn/math/math.h"
#include "limn/scene/texture/solid.h"
#include "property.h"

namespace limn::checker_test {

namespace {

const double kNaN = std::nan("");

bool even_at(double x, double scale = 1) { return pattern::checker_is_even({x, 0, 0}, scale); }

Surface at(const Point3& p) {
    Surface s;
    s.position = p;
    return s;
}

}  // namespace

TEST_CASE("Checker: a cell's parity is that of floor, below zero too", "[texture][checker]") {
    CHECK(even_at(0));
    CHECK(even_at(-0.0));
    CHECK(even_at(0.999));
    CHECK_FALSE(even_at(1));
    CHECK_FALSE(even_at(-1e-30));
    CHECK_FALSE(even_at(-1));
    CHECK(even_at(-1 - 0x1p-23));
    CHECK(even_at(-2));
}

TEST_CASE("Checker: parity is right as long as doubles have odd integers", "[texture][checker]") {
    CHECK(even_at(0x1p31 + 0.5));
    CHECK_FALSE(even_at(0x1p31 + 1.5));
    CHECK_FALSE(even_at(-0x1p31 - 0.5));
    CHECK_FALSE(even_at(0x1p53 - 1));
    CHECK_FALSE(even_at(1 - 0x1p53));
    for (const double huge : {0x1p53, 0x1p53 + 2, 1e20, 1e308, kInfinity}) {
        CHECK(even_at(huge));
        CHECK(even_at(-huge));
    }
}

TEST_CASE("Checker: a coordinate that is no number counts as even", "[texture][checker]") {
    CHECK(even_at(kNaN));
    CHECK_FALSE(pattern::checker_is_even({kNaN, 1, 0}, 1));
}

TEST_CASE("Checker: parity is the sum over the axes, as in whole numbers", "[texture][checker]") {
    std::mt19937_64 random(72);
    std::uniform_real_distribution<double> coordinate(-1e6, 1e6);
    for (int i = 0; i < 100'000; ++i) {
        const Point3 p{coordinate(random), coordinate(random), coordinate(random)};
        const auto cell = [](double x) { return static_cast<std::int64_t>(std::floor(x / 0.32)); };
        const bool even = (cell(p.x) + cell(p.y) + cell(p.z)) % 2 == 0;
        if (pattern::checker_is_even(p, 0.32) != even) FAIL("wrong parity at " << p.x << ' ' << p.y << ' ' << p.z);
    }
}

TEST_CASE("Checker: a step of one cell along an axis changes the parity, two steps do not", "[texture][checker]") {
    test::holds([](std::int32_t x, std::int32_t y, std::int32_t z, std::int16_t steps) {
        // Coordinates and steps are exact multiples of 2^-8.
        const double scale = 0.75, at[3] = {std::ldexp(x, -8), std::ldexp(y, -8), std::ldexp(z, -8)};
        const bool even = pattern::checker_is_even({at[0], at[1], at[2]}, scale);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Point3 p{at[0], at[1], at[2]};
            p[axis] += steps * scale;
            RC_ASSERT(pattern::checker_is_even(p, scale) == (even == (steps % 2 == 0)));
        }
    });
}

TEST_CASE("Checker: even cells have the first texture, odd ones the second", "[texture][checker]") {
    const Color even{.2, .3, .1}, odd{.9, .8, .7};
    const Checker checker(0.5, even, odd);
    CHECK(checker.value(at({.1, .1, .1})) == even);
    CHECK(checker.value(at({.6, .1, .1})) == odd);
    CHECK(checker.value(at({.6, .6, .1})) == even);
    CHECK(checker.value(at({.6, .6, -.1})) == odd);
}

TEST_CASE("Checker: its cells can hold textures of their own", "[texture][checker]") {
    const auto fine = std::make_shared<Checker>(0.25, Color{1, 0, 0}, Color{0, 1, 0});
    const Checker checker(1, fine, std::make_shared<SolidColor>(Color{0, 0, 1}));
    CHECK(checker.value(at({.1, .1, .1})) == Color{1, 0, 0});
    CHECK(checker.value(at({.3, .1, .1})) == Color{0, 1, 0});
    CHECK(checker.value(at({1.1, .1, .1})) == Color{0, 0, 1});
}

TEST_CASE("Checker: impossible arguments are refused", "[texture][checker]") {
    for (const double scale : {0.0, -1.0, kNaN, kInfinity})
        CHECK_THROWS_AS(Checker(scale, Color{}, Color{}), ArgumentError);
    CHECK_THROWS_AS(Checker(1, Color{-1, 0, 0}, Color{}), ArgumentError);
    CHECK_THROWS_AS(Checker(1, Color{}, Color{0, kNaN, 0}), ArgumentError);
    const auto solid = std::make_shared<SolidColor>(Color{1, 1, 1});
    CHECK_THROWS_AS(Checker(1, nullptr, solid), ArgumentError);
    CHECK_THROWS_AS(Checker(1, solid, nullptr), ArgumentError);
}

}  // namespace limn::checker_test
