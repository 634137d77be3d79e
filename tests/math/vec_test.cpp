#include "limn/math/vec.h"

#include <limits>
#include <type_traits>

#include "catch.h"
#include "limn/math/math.h"
#include "limn/math/ray.h"
#include "property.h"
#include "support/grid.h"
#include "support/random_geometry.h"

namespace limn::vec_test {

using limn::test::Random;

TEST_CASE("Vec3: the cross product is perpendicular to both factors and as long as Lagrange's identity says",
          "[core][vec]") {
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 a = random.in_cube(), b = random.in_cube();
        const Vec3 n = cross(a, b);
        CHECK(std::abs(dot(n, a)) <= 1e-15);
        CHECK(std::abs(dot(n, b)) <= 1e-15);
        CHECK(length_squared(n) == Approx(length_squared(a) * length_squared(b) - dot(a, b) * dot(a, b)).margin(1e-14));
    }
    CHECK(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}) == Vec3{0, 0, 1});  // right-handed
    CHECK(cross(Vec3{0, 1, 0}, Vec3{0, 0, 1}) == Vec3{1, 0, 0});
}

TEST_CASE("Vec3: the length neither overflows nor underflows", "[core][vec]") {
    CHECK(length({3e200, 4e200, 0}) == Approx(5e200));
    CHECK(length({3e-200, 0, -4e-200}) == Approx(5e-200));
    CHECK(length({}) == 0);
}

TEST_CASE("Vec3: normalize gives unit length and the same direction for any finite length", "[core][vec]") {
    Random random(2);
    for (int i = 0; i < 5000; ++i) {
        const Vec3 unit = random.unit();
        const Vec3 n = normalize(random.log_uniform(1e-300, 1e300) * unit);
        CHECK(std::abs(length(n) - 1) <= 4 * kRoundoff);
        CHECK(length(n - unit) <= 8 * kRoundoff);
    }
    CHECK(length(normalize(Vec3{5e-324, 0, 0})) == 1);
    const double huge = std::numeric_limits<double>::max();
    CHECK(length(normalize(Vec3{huge, -huge, huge})) == Approx(1));
    CHECK(std::isnan(normalize(Vec3{}).x));
}

TEST_CASE("Vec3: unit_cross is the same at every size of its factors, to the bit, and NaN where they are parallel",
          "[core][vec]") {
    test::holds([] {
        const Vec3 a = test::draw_vec(), b = test::draw_vec();
        const double s = test::draw_power_of_two(-500, 480), t = test::draw_power_of_two(-500, 480);
        const Vec3 n = unit_cross(a, b), far = unit_cross(s * a, t * b);
        if (cross(a, b) == Vec3{}) {
            RC_ASSERT((std::isnan(n.x) && std::isnan(far.x)));
            return;
        }
        RC_ASSERT(n == far);
        RC_ASSERT(std::abs(length(n) - 1) <= gamma(8));
        RC_ASSERT(dot(n, cross(a, b)) > 0);
        RC_ASSERT(max_abs(cross(n, normalize(cross(a, b)))) <= gamma(8));
        RC_ASSERT(std::isnan(unit_cross(s * a, 3 * t * a).x));
    });
}

TEST_CASE("Points, vectors and normals do not turn into each other by accident", "[core][vec]") {
    STATIC_REQUIRE_FALSE(std::is_convertible_v<Vec3, Normal3>);
    STATIC_REQUIRE_FALSE(std::is_convertible_v<Normal3, Vec3>);
    STATIC_REQUIRE_FALSE(std::is_convertible_v<Point3, Vec3>);
    STATIC_REQUIRE_FALSE(std::is_constructible_v<Vec3, Point3>);
    STATIC_REQUIRE(std::is_same_v<decltype(Point3{} - Point3{}), Vec3>);
    STATIC_REQUIRE(std::is_same_v<decltype(Point3{} + Vec3{}), Point3>);
    CHECK(Vec3(Normal3(Vec3{1, -2, 3})) == Vec3{1, -2, 3});
    CHECK(-Normal3{1, -2, 3} == Normal3{-1, 2, -3});
}

TEST_CASE("Vec3: sums, differences and multiples go component by component, for points as well", "[core][vec]") {
    const Vec3 a{1, 2, 4}, b{16, -8, 32};
    const Point3 p{3, 5, 7};
    CHECK(a + b == Vec3{17, -6, 36});
    CHECK(a - b == Vec3{-15, 10, -28});
    CHECK(-a == Vec3{-1, -2, -4});
    CHECK((2 * a == Vec3{2, 4, 8} && a * 2 == Vec3{2, 4, 8} && a / 2 == Vec3{0.5, 1, 2}));
    CHECK((p + a == Point3{4, 7, 11} && p - a == Point3{2, 3, 3} && (p + a) - p == a));
    CHECK((dot(a, b) == 128 && dot(Normal3(a), b) == 128 && dot(b, Normal3(a)) == 128));
    CHECK((dot(Normal3(a), Normal3(b)) == 128 && length_squared(a) == 21));
    CHECK(cross(a, b) == Vec3{64 + 32, 64 - 32, -8 - 32});
    for (const Vec3& v :
         {Vec3{-9, 2, 3}, Vec3{2, -9, 3}, Vec3{2, 3, -9}, Vec3{9, -2, 3}, Vec3{2, 9, -3}, Vec3{-2, 3, 9}})
        CHECK((max_abs(v) == 9 && max_abs(Point3{} + v) == 9));
    const Ray ray{.origin = p, .direction = a};
    CHECK((ray.at(0) == p && ray.at(2) == Point3{5, 9, 15} && ray.at(-1) == Point3{2, 3, 3}));
    CHECK((gamma(1) >= kRoundoff && gamma(1) < 1.0001 * kRoundoff && gamma(8) / kRoundoff == Approx(8)));
    CHECK((radians(180) == kPi && radians(-90) == -kPi / 2));
}

TEST_CASE("Vec3: an axis number reads and writes the component", "[core][vec]") {
    Vec3 v{1, 2, 3};
    v[1] = 7;
    CHECK((v[0] == 1 && v[1] == 7 && v[2] == 3 && v.y == 7));
    CHECK(limn::abs(Vec3{-1, 2, -3}) == Vec3{1, 2, 3});
}

TEST_CASE("is_finite: one NaN or infinity in any component is found", "[core][vec]") {
    for (std::size_t a = 0; a < 3; ++a) {
        for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity}) {
            Vec3 v{1, 2, 3};
            Point3 p{1, 2, 3};
            v[a] = bad, p[a] = bad;
            CHECK_FALSE(is_finite(v));
            CHECK_FALSE(is_finite(p));
            CHECK_FALSE(is_finite(Normal3(v)));
        }
    }
    CHECK(is_finite(Vec3{1e308, -1e308, 0}));
}

TEST_CASE("is_usable: refuses a ray exactly when a field is NaN, infinite or contradictory", "[core][ray]") {
    for (const Ray& ray : test::unusable_rays()) CHECK_FALSE(is_usable(ray));
    Ray ray{.origin = {3e38, -3e38, 0}, .direction = {0, 0, 1e-320}};
    CHECK(is_usable(ray));
    ray.t_min = -kInfinity;
    CHECK(is_usable(ray));
    ray.t_min = ray.t_max = 5;  // empty, yet in order
    CHECK(is_usable(ray));
    ray.time = -3;
    CHECK(is_usable(ray));
}

}  // namespace limn::vec_test
