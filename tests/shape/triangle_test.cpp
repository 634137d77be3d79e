#include "limn/scene/shape/triangle.h"

#include "catch.h"
#include "limn/math/error.h"
#include "support/random_geometry.h"

namespace limn::triangle_test {

using limn::test::Random;

namespace {

struct Corners {
    Point3 a, b, c;
};

}  // namespace

TEST_CASE("Triangle: it is a closed set, vertices and edges are hits", "[shape][triangle]") {
    const Point3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};  // all that follows is exact in double
    const Triangle triangle(a, b, c, nullptr);
    for (const Point3 on : {a, b, c, Point3{2, 0, 0}, Point3{0, 1, 0}, Point3{2, 2, 0}, Point3{3, 1, 0}}) {
        for (const Vec3 d : {Vec3{0, 0, -1}, Vec3{0, 0, 1}, Vec3{1, 2, 4}, Vec3{-2, 1, -4}, Vec3{-0.0, -0.0, 8}}) {
            const auto hit = triangle.hit({.origin = on - 3 * d, .direction = d});
            REQUIRE(hit);
            CHECK(hit->t == 3);
        }
    }
    for (const Point3 off : {Point3{-0x1p-40, 1, 0}, Point3{2, -0x1p-40, 0}, Point3{2, 2 + 0x1p-40, 0}})
        CHECK_FALSE(triangle.hit({.origin = off + Vec3{0, 0, 3}, .direction = {0, 0, -1}}));
}

TEST_CASE("Triangle: a ray in its own plane misses", "[shape][triangle]") {
    const Triangle triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, nullptr);
    for (const Vec3 d : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 0}, Vec3{-1, 2, 0}, Vec3{1, 0, -0.0}})
        for (const Point3 o : {Point3{-1, 1, 0}, Point3{1, 1, 0}, Point3{0, 0, 0}, Point3{-1, 0, 0}})
            CHECK_FALSE(triangle.hit({.origin = o, .direction = d}));
}

TEST_CASE("Triangle: collinear vertices have no area: pbrt's bad case is refused", "[shape][triangle]") {
    // Vertices that share x and z are collinear whatever their y.
    const Point3 a{-1113.45459, -79.049614, -56.2431908}, b{-1113.45459, -87.0922699, -56.2431908},
        c{-1113.45459, -79.2090149, -56.2431908};
    CHECK_THROWS_AS(Triangle(a, b, c, nullptr), ArgumentError);
    CHECK_THROWS_WITH(Triangle(a, b, c, nullptr), Catch::Contains("area"));
}

TEST_CASE("Triangle: no area, NaN and infinity are refused, tiny and huge are not", "[shape][triangle]") {
    const Point3 o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0};
    CHECK_THROWS_AS(Triangle(o, o, y, nullptr), ArgumentError);
    CHECK_THROWS_AS(Triangle(o, x, x, nullptr), ArgumentError);
    CHECK_THROWS_AS(Triangle(x, y, x, nullptr), ArgumentError);
    CHECK_THROWS_AS(Triangle(o, o, o, nullptr), ArgumentError);
    CHECK_THROWS_AS(Triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2}, nullptr), ArgumentError);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity}) {
        CHECK_THROWS_AS(Triangle({bad, 0, 0}, x, y, nullptr), ArgumentError);
        CHECK_THROWS_AS(Triangle(o, {0, bad, 0}, y, nullptr), ArgumentError);
        CHECK_THROWS_WITH(Triangle(o, x, {0, 0, bad}, nullptr), Catch::Contains("finite"));
    }
    CHECK_NOTHROW(Triangle(o, {1e-100, 0, 0}, {0, 1e-100, 0}, nullptr));
    CHECK_NOTHROW(Triangle(o, {1e100, 0, 0}, {0, 1e100, 0}, nullptr));
}

TEST_CASE("Triangle: the range is open at t_min and closed at t_max", "[shape][triangle]") {
    const Triangle triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, nullptr);
    const auto hits = [&](double t_min, double t_max) {
        return triangle.hit({{1, 1, 8}, {0, 0, -2}, t_min, t_max, 0}).has_value();
    };
    CHECK(hits(0, 4));
    CHECK_FALSE(hits(0, std::nextafter(4, 0)));
    CHECK_FALSE(hits(4, kInfinity));
    CHECK(hits(std::nextafter(4, 0), kInfinity));
    CHECK_FALSE(hits(4, 4));
    CHECK(hits(-kInfinity, kInfinity));
    CHECK(triangle.hit({{1, 1, 0}, {0, 0, 1}, -1, 1, 0})->t == 0);
    CHECK_FALSE(triangle.hit({{1, 1, 0}, {0, 0, 1}, 0, 1, 0}));
}

TEST_CASE("Triangle: its normal is (b - a) x (c - a), and its box contains every hit", "[shape][triangle]") {
    Random random(33);
    for (int i = 0; i < 3000; ++i) {
        const Corners k{Point3{} + random.in_cube(3), Point3{} + random.in_cube(3), Point3{} + random.in_cube(3)};
        const Triangle triangle(k.a, k.b, k.c, nullptr);
        const Point3 aim = k.a + 0.3 * (k.b - k.a) + 0.3 * (k.c - k.a);
        const Ray ray{.origin = aim + 3 * random.unit(), .direction = {}};
        const auto hit = triangle.hit({.origin = ray.origin, .direction = aim - ray.origin});
        REQUIRE(hit);
        CHECK(length(Vec3(hit->normal) - normalize(cross(k.b - k.a, k.c - k.a))) <= 1e-15);
        const Box box = grow(triangle.bounds(), {1e-13, 1e-13, 1e-13});
        CHECK(box.contains(ray.origin + hit->t * (aim - ray.origin)));
        CHECK(triangle.bounds().contains(k.a));
        CHECK(triangle.bounds().contains(k.b));
        CHECK(triangle.bounds().contains(k.c));
    }
}

TEST_CASE("Triangle: an unusable ray misses", "[shape][triangle]") {
    const Triangle triangle({-4, -4, 0}, {4, -4, 0}, {0, 4, 0}, nullptr);
    for (const Ray& ray : test::unusable_rays()) CHECK_FALSE(triangle.hit(ray));
}

}  // namespace limn::triangle_test
