// Agreement with the exact answer is asked for wherever plain double can decide: see support/truth.h for the margin.
#include "limn/shape/triangle.h"

#include "catch.h"
#include "limn/core/error.h"
#include "support/random_geometry.h"
#include "support/truth.h"

using namespace limn;
using limn::test::Random;
using limn::test::Tally;

namespace {

constexpr double kUlp = 0x1p-23;

struct Corners {
    Point3 a, b, c;
};

void judge_ray(Tally& tally, const Corners& k, const Ray& ray) {
    const auto hit = Triangle(k.a, k.b, k.c, nullptr).hit(ray);
    const test::Truth truth = test::true_triangle_hit(k.a, k.b, k.c, ray);
    judge(tally, ray, truth, hit);
    judge_uv(tally, ray, truth, hit);
    if (hit && !(hit->u >= 0 && hit->v >= 0 && hit->u + hit->v <= 1 + 1e-15)) tally.fault(ray, "u, v outside");
}

test::Targets targets_of(const Corners& k) {
    const auto between = [](const Point3& p, const Point3& q, double s) { return p + s * (q - p); };
    return {Triangle(k.a, k.b, k.c, nullptr).bounds(),
            {k.a, k.b, k.c, between(k.a, k.b, 0.5), between(k.b, k.c, 0.25), between(k.c, k.a, 0.125),
             between(between(k.a, k.b, 0.5), k.c, 0.3)}};
}

}  // namespace

TEST_CASE("Triangle: hits what exact arithmetic hits, at the same t, u, v, on random and degenerate rays",
          "[shape][triangle]") {
    Random random(30);
    const Corners fixed[] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                             {{1e5, 1e5, 1e5}, {1e5 + 1, 1e5, 1e5}, {1e5, 1e5 + 1, 1e5 - 1}},
                             {{-5, 0, 2}, {4, 1e-3, 2}, {3, 2, -7}},
                             {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-4, 0}}};
    for (int i = 0; i < 12; ++i) {
        Corners k;
        if (i < 4) {
            k = fixed[i];
        } else {
            const double scale = random.log_uniform(1e-12, 1e12);
            k = {Point3{} + random.in_cube(scale), Point3{} + random.in_cube(scale), Point3{} + random.in_cube(scale)};
        }
        const test::Targets targets = targets_of(k);
        Tally tally;
        for (int n = 0; n < 10000; ++n) judge_ray(tally, k, random_ray(random, targets));
        INFO("triangle " << i << ": " << tally.first);
        CHECK(tally.wrong == 0);
        CHECK(tally.judged > tally.rays / 4);  // the others lie on vertices and edges on purpose
        CHECK(tally.hits > tally.rays / 50);
    }
}

TEST_CASE("Triangle: single slivers of aspect 1e2 to 1e7 are decided as exact arithmetic does", "[shape][triangle]") {
    Random random(31);
    for (double aspect = 1e2; aspect <= 1e7; aspect *= 10) {
        Tally tally;
        for (int i = 0; i < 3000; ++i) {
            const Vec3 along = random.unit(), across = normalize(cross(along, random.unit()));
            const Point3 a = Point3{} + random.in_cube(5);
            const Corners k{a, a + along, a + random.uniform() * along + across / aspect};
            const double u = random.uniform(-0.2, 1.2), v = random.uniform(-0.2, 1.2);
            const Point3 aim = a + u * (k.b - a) + v * (k.c - a);
            const Point3 eye = aim + random.uniform(1, 10) * random.unit();
            judge_ray(tally, k, {.origin = eye, .direction = aim - eye});
        }
        INFO("aspect " << aspect << ": " << tally.first);
        CHECK(tally.wrong == 0);
        CHECK(tally.judged >= tally.rays * 9 / 10);
        CHECK(tally.hits > 300);
    }
}

TEST_CASE("Triangle: grazing rays, down to a microradian, are decided as exact arithmetic does", "[shape][triangle]") {
    Random random(32);
    const Corners k{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (double angle = 1e-1; angle >= 0.9e-6; angle /= 10) {
        Tally tally;
        for (int i = 0; i < 5000; ++i) {
            const Point3 aim{random.uniform(-0.1, 1), random.uniform(-0.1, 1), 0};
            const double around = random.uniform(0, 2 * kPi);
            const Vec3 d{std::cos(around) * std::cos(angle), std::sin(around) * std::cos(angle), -std::sin(angle)};
            judge_ray(tally, k, {.origin = aim - 10 * d, .direction = d});
        }
        INFO("angle " << angle << ": " << tally.first);
        CHECK(tally.wrong == 0);
        CHECK(tally.judged >= tally.rays * 99 / 100);
        CHECK(tally.hits > 1000);
    }
}

TEST_CASE("Triangle: size does not matter, no triangle is too small or too large", "[shape][triangle]") {
    for (int k = -100; k <= 100; ++k) {
        const double s = std::pow(10.0, k);
        const Triangle triangle({0, 0, 0}, {s, 0, 0}, {0, s, 0}, nullptr);
        const auto hit = triangle.hit({.origin = {s / 3, s / 3, -10 * s}, .direction = {0, 0, 1}});
        INFO("size 1e" << k);
        REQUIRE(hit);
        CHECK(std::abs(hit->t - 10 * s) <= kUlp * 10 * s);
        CHECK(std::abs(hit->u - 1.0 / 3) <= kUlp);
        CHECK_FALSE(triangle.hit({.origin = {-s / 1e6, s / 3, -10 * s}, .direction = {0, 0, 1}}));
    }
    const double s = 2e-4;
    const auto hit =
        Triangle({0, 0, 0}, {s, 0, 0}, {0, s, 0}, nullptr).hit({.origin = {s / 3, s / 3, -1}, .direction = {0, 0, 1}});
    REQUIRE(hit);
    CHECK(hit->t == 1);
}

TEST_CASE("Triangle: the length of the direction only scales t, from 1e-30 to 1e25", "[shape][triangle]") {
    const Triangle triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, nullptr);
    for (int k = -30; k <= 25; ++k) {
        const double s = std::pow(10.0, k);
        const auto hit = triangle.hit({.origin = {0.25, 0.25, 3}, .direction = {0, 0, -s}});
        REQUIRE(hit);
        CHECK(std::abs(hit->t * s - 3) <= 3 * kUlp);
    }
}

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
