#include "geometry/dyadic.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "catch.h"
#include "support/random_geometry.h"

namespace limn::dyadic_test {

using Rational = boost::multiprecision::cpp_rational;

namespace {

// Doubles of every size, whole numbers, and values that cancel.
std::vector<double> awkward_doubles() {
    std::vector<double> values{
        0.0,       -0.0,   1.0,    -1.0,    3.0,     0.1,      0x1p-1074, -0x1p-1074, 0x1.fffffffffffffp1023,
        0x1p-1022, 0x1p63, 0x1p64, -0x1p64, 0x1p-64, 0x1.8p-65};
    test::Random random(31);
    for (int i = 0; i < 12; ++i) {
        values.push_back(std::ldexp(random.uniform(-1, 1), static_cast<int>(random.index(200)) - 100));
        values.push_back(std::ldexp(random.uniform(-1, 1), static_cast<int>(random.index(2000)) - 1000));
        values.push_back(std::nextafter(values.back(), 0));
    }
    return values;
}

int sign(const Rational& r) { return r < 0 ? -1 : r > 0 ? 1 : 0; }

}  // namespace

TEST_CASE("Dyadic: sums, differences and products of doubles have the sign of the exact ones", "[core][dyadic]") {
    const std::vector<double> values = awkward_doubles();
    int wrong = 0;
    for (const double a : values)
        for (const double b : values) {
            const Dyadic x = a, y = b;
            const Rational p = Rational(a), q = Rational(b);
            wrong += (x + y).sign() != sign(p + q) || (x - y).sign() != sign(p - q) || (x * y).sign() != sign(p * q);
            wrong += (x * x - y * y).sign() != sign(p * p - q * q);
            wrong += (x * y + x - y * x - x).sign() != 0 || (x < y) != (p < q) || (x == y) != (p == q);
        }
    CHECK(wrong == 0);
}

TEST_CASE("Dyadic: a sum of many products keeps every bit", "[core][dyadic]") {
    const std::vector<double> values = awkward_doubles();
    Dyadic sum;
    Rational expected;
    for (const double a : values)
        for (const double b : values) {
            sum = sum + Dyadic(a) * Dyadic(b) * Dyadic(a);
            expected += Rational(a) * Rational(b) * Rational(a);
        }
    CHECK(sum.sign() == sign(expected));
    for (const double a : values)
        for (const double b : values) sum = sum - Dyadic(b) * Dyadic(a) * Dyadic(a);
    CHECK(sum.sign() == 0);
    CHECK((sum + Dyadic(0x1p-1074)).sign() == 1);
}

TEST_CASE("Dyadic: copies, moved and negated ones keep the value, short and long", "[core][dyadic]") {
    Dyadic number = 0x1.8p-1000;
    for (int i = 0; i < 3; ++i) {  // 1, then some 2000, then 4000 bits
        Dyadic copy = number, moved = std::move(copy);
        CHECK(moved == number);
        copy = moved;
        CHECK((copy - number).sign() == 0);
        CHECK((number + -copy).sign() == 0);
        number = number * number + Dyadic(0x1p1000);
    }
}

TEST_CASE("ratio: a quotient that is a double is that double, any other lies within rounding", "[core][dyadic]") {
    test::Random random(32);
    int wrong = 0;
    for (int i = 0; i < 2000; ++i) {
        const double q = std::ldexp(random.uniform(-1, 1), static_cast<int>(random.index(600)) - 300);
        const double d = std::ldexp(random.uniform(-1, 1), static_cast<int>(random.index(600)) - 300);
        wrong += ratio(Dyadic(q) * Dyadic(d), Dyadic(d)) != q;
        const Rational exact = Rational(q) / Rational(d), found = Rational(ratio(q, d));
        wrong += abs(found - exact) > abs(exact) * Rational(0x1.01p-53);
    }
    CHECK(wrong == 0);
    CHECK(ratio(0.0, 3.0) == 0);
    CHECK(ratio(1.0, 3.0) == 1.0 / 3.0);
    CHECK(ratio(-2.0, 3.0) == -2.0 / 3.0);
    CHECK(ratio(0x1p1000, 0x1p-1000) == std::numeric_limits<double>::infinity());
    CHECK(ratio(0x1p-1000, -0x1p1000) == 0);
    CHECK(ratio(0x1p-1000, 0x1p74) == 0x1p-1074);
}

TEST_CASE("Dyadic::square_root: right to 60 bits, and exact for squares", "[core][dyadic]") {
    test::Random random(33);
    int wrong = 0;
    for (int i = 0; i < 2000; ++i) {
        const double x = std::ldexp(random.uniform(), static_cast<int>(random.index(1800)) - 900);
        const Dyadic square = Dyadic(x) * Dyadic(x), root = Dyadic(x).square_root();
        wrong += !(square.square_root() == Dyadic(x));
        const Dyadic error = Dyadic(x) - root * root;
        wrong += error.sign() < 0 || Dyadic(x) * Dyadic(0x1p-59) < error;
    }
    CHECK(wrong == 0);
    CHECK(Dyadic(0.0).square_root().sign() == 0);
    CHECK(Dyadic(2.0).square_root() < Dyadic(1.5));
    CHECK(Dyadic(0x1p-1074).square_root() == Dyadic(0x1p-537));
    CHECK(Dyadic(0x1p-1073).square_root() < Dyadic(0x1.7p-537));
}

}  // namespace limn::dyadic_test
