#include "math/elementary.h"

#include "catch.h"
#include "limn/math/math.h"
#include "support/random_geometry.h"

namespace limn::elementary_test {

using namespace test;

namespace {

using Truth = long double;

// How far `got` is from `truth`, in units of the last place of double.
double units_off(double got, Truth truth) {
    int exponent = 0;
    std::frexp(truth, &exponent);
    return static_cast<double>(std::fabs(got - truth) / std::ldexp(Truth{1}, std::max(exponent - 53, -1074)));
}

enum class Spread { even, over_sizes };

struct Row {
    const char* name;
    double (*function)(double);
    Truth (*truth)(Truth);
    Spread spread;
    double from, to;
    double bound;
};

const Row kRows[] = {
    {"exp", exponential, std::exp, Spread::even, -20, 3, 1},
    {"exp", exponential, std::exp, Spread::even, -745, 709, 1},
    {"log", logarithm, std::log, Spread::even, 0, 1, 1},
    {"log", logarithm, std::log, Spread::over_sizes, 1e-320, 1e300, 1},
    {"log(1 + x)", logarithm_of_1_plus, std::log1p, Spread::even, -1, 1, 3},
    {"log(1 + x)", logarithm_of_1_plus, std::log1p, Spread::over_sizes, 1e-300, 1e300, 3},
    {"sin", sine, std::sin, Spread::even, -7, 7, 2},
    {"sin", sine, std::sin, Spread::even, -1e6, 1e6, 2},
    {"cos", cosine, std::cos, Spread::even, -7, 7, 2},
    {"tan", tangent, std::tan, Spread::even, -kPi / 2, kPi / 2, 3},
    {"tan", tangent, std::tan, Spread::over_sizes, 1e-300, 1, 3},
    {"arc cos", arc_cosine, std::acos, Spread::even, -1, 1, 4},
    {"arc tan", arc_tangent, std::atan, Spread::even, -9, 9, 2},
};

}  // namespace

TEST_CASE("Elementary: all functions are right to some units in the last place", "[core][elementary]") {
    Random random(77);
    for (const Row& row : kRows) {
        CAPTURE(row.name, row.from, row.to);
        double worst = 0;
        for (int i = 0; i < 100000; ++i) {
            const double x =
                row.spread == Spread::even ? random.uniform(row.from, row.to) : random.log_uniform(row.from, row.to);
            worst = std::max(worst, units_off(row.function(x), row.truth(x)));
        }
        CHECK(worst <= row.bound);
    }
    double worst_angle = 0, worst_power = 0;
    for (int i = 0; i < 100000; ++i) {
        const double y = random.uniform(-1, 1), x = random.uniform(-1, 1), base = random.uniform(0.04, 1);
        worst_angle = std::max(worst_angle, units_off(arc_tangent(y, x), std::atan2(Truth{y}, Truth{x})));
        worst_power = std::max(worst_power, units_off(power(base, 2.4), std::pow(Truth{base}, Truth{2.4})) /
                                                (2 + 2 * std::abs(2.4 * std::log(base))));
    }
    CHECK(worst_angle <= 3);
    CHECK(worst_power <= 1);
}

TEST_CASE("Elementary: functions are exact at the ends of their domains, and NaN of a NaN", "[core][elementary]") {
    const double nan = std::nan("");
    CHECK(exponential(0) == 1);
    CHECK(exponential(kInfinity) == kInfinity);
    CHECK(exponential(710) == kInfinity);
    CHECK(exponential(-kInfinity) == 0);
    CHECK(exponential(-746) == 0);
    CHECK(exponential(-745) == 0x1p-1074);
    CHECK(logarithm(1) == 0);
    CHECK(logarithm(0) == -kInfinity);
    CHECK(logarithm(kInfinity) == kInfinity);
    CHECK(logarithm_of_1_plus(-1) == -kInfinity);
    CHECK(logarithm_of_1_plus(0x1p-60) == 0x1p-60);
    CHECK(power(0, 2.2) == 0);
    CHECK(power(1, 2.2) == 1);
    CHECK(std::abs(sine(1e300)) <= 1);
    CHECK(sine(0) == 0);
    CHECK(arc_cosine(1) == 0);
    CHECK(arc_cosine(-1) == kPi);
    CHECK(arc_tangent(0, 0) == 0);
    CHECK(arc_tangent(0, -1) == kPi);
    CHECK(arc_tangent(-0.0, -1) == -kPi);
    CHECK(arc_tangent(-kInfinity) == -kPi / 2);
    for (const auto& f : {exponential, logarithm, sine, cosine, tangent, arc_cosine, logarithm_of_1_plus})
        CHECK(std::isnan(f(nan)));
    CHECK(std::isnan(arc_tangent(nan, 1)));
    CHECK(std::isnan(arc_tangent(1, nan)));
    CHECK(std::isnan(sine(kInfinity)));
}

}  // namespace limn::elementary_test
