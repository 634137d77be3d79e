// Agreement with the exact answer is asked for wherever plain double can decide: see support/truth.h for the margin.
#include "limn/shape/quad.h"

#include "catch.h"
#include "limn/core/error.h"
#include "limn/shape/hittable_list.h"
#include "support/random_geometry.h"
#include "support/truth.h"

using namespace limn;
using limn::test::Random;
using limn::test::Tally;

namespace {

constexpr double kUlp = 0x1p-23;

struct Sides {
    Point3 corner;
    Vec3 u, v;
};

void judge_ray(Tally& tally, const Sides& s, const Ray& ray) {
    const auto hit = Quad(s.corner, s.u, s.v, nullptr).hit(ray);
    const test::Truth truth = test::true_quad_hit(s.corner, s.u, s.v, ray);
    judge(tally, ray, truth, hit);
    judge_uv(tally, ray, truth, hit);
    if (hit && !(hit->u >= 0 && hit->u <= 1 && hit->v >= 0 && hit->v <= 1)) tally.fault(ray, "u, v outside");
}

}  // namespace

TEST_CASE("Quad: hits what exact arithmetic hits, at the same t, u, v, on random and degenerate rays",
          "[shape][quad]") {
    Random random(40);
    const Sides fixed[] = {{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}},
                           {{213, 554, 227}, {130, 0, 0}, {0, 0, 105}},
                           {{1e5, -1, 3}, {0, 2, 0}, {0, 0, 1}},
                           {{0, 0, 0}, {1, 0, 0}, {std::cos(radians(0.1)), std::sin(radians(0.1)), 0}},
                           {{2, 1, 0}, {1e4, 0, 3}, {0, 1, 1}}};
    for (int i = 0; i < 12; ++i) {
        const double scale = random.log_uniform(1e-12, 1e12);
        const Sides s =
            i < 5 ? fixed[i] : Sides{Point3{} + random.in_cube(scale), random.in_cube(scale), random.in_cube(scale)};
        const Point3 c = s.corner;
        const test::Targets targets{
            Quad(c, s.u, s.v, nullptr).bounds(),
            {c, c + s.u, c + s.v, c + s.u + s.v, c + 0.5 * s.u, c + s.u + 0.25 * s.v, c + 0.5 * s.u + 0.5 * s.v}};
        Tally tally;
        for (int n = 0; n < 10000; ++n) judge_ray(tally, s, random_ray(random, targets));
        INFO("quad " << i << ": " << tally.first);
        CHECK(tally.wrong == 0);
        CHECK(tally.judged > tally.rays / 4);  // the others lie on corners and edges on purpose
        CHECK(tally.hits > tally.rays / 50);
    }
}

TEST_CASE("Quad: the length of the direction only scales t, from 1e-30 to 1e25", "[shape][quad]") {
    const Quad quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, nullptr);
    for (int k = -30; k <= 25; ++k) {
        const double s = std::pow(10.0, k);
        const auto hit = quad.hit({.origin = {0, 0, 1}, .direction = {0, 0, -s}});
        REQUIRE(hit);
        CHECK(std::abs(hit->t * s - 1) <= kUlp);
    }
}

TEST_CASE("Quad: parallel or zero edges, NaN and infinity are refused by name", "[shape][quad]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(Quad({0, 0, 0}, {1, 2, 3}, {2, 4, 6}, nullptr), ArgumentError);
    CHECK_THROWS_AS(Quad({0, 0, 0}, {1, 2, 3}, {-1, -2, -3}, nullptr), ArgumentError);
    CHECK_THROWS_WITH(Quad({0, 0, 0}, {0, 0, 0}, {0, 1, 0}, nullptr), Catch::Contains("edge"));
    CHECK_THROWS_AS(Quad({0, 0, 0}, {1, 0, 0}, {0, 0, 0}, nullptr), ArgumentError);
    CHECK_THROWS_WITH(Quad({nan, 0, 0}, {1, 0, 0}, {0, 1, 0}, nullptr), Catch::Contains("corner"));
    CHECK_THROWS_WITH(Quad({0, 0, 0}, {1, nan, 0}, {0, 1, 0}, nullptr), Catch::Contains("edge"));
    CHECK_THROWS_AS(Quad({0, 0, 0}, {1, 0, 0}, {0, kInfinity, 0}, nullptr), ArgumentError);
    CHECK_NOTHROW(Quad({0, 0, 0}, {1, 0, 0}, {1, 1e-9, 0}, nullptr));
    CHECK_NOTHROW(Quad({0, 0, 0}, {1e-90, 0, 0}, {0, 1e-90, 0}, nullptr));
    for (const double scale : {0x1p-400, 0x1p-170, 0x1p170, 0x1p400})  // where squares of areas leave double's range
        CHECK_THROWS_AS(Quad({0, 0, 0}, scale * Vec3{1, 3, 5}, scale * Vec3{7, 21, 35}, nullptr), ArgumentError);
}

TEST_CASE("Quad: it is a closed set, corners and edges are hits, its plane is not", "[shape][quad]") {
    const Quad quad({0, 0, 0}, {4, 0, 0}, {0, 2, 0}, nullptr);
    for (const Point3 on :
         {Point3{0, 0, 0}, Point3{4, 0, 0}, Point3{4, 2, 0}, Point3{0, 2, 0}, Point3{2, 0, 0}, Point3{4, 1, 0}}) {
        for (const Vec3 d : {Vec3{0, 0, -1}, Vec3{1, 2, 4}, Vec3{-2, 1, -4}}) {
            const auto hit = quad.hit({.origin = on - 3 * d, .direction = d});
            REQUIRE(hit);
            CHECK(hit->t == 3);
        }
    }
    CHECK_FALSE(quad.hit({.origin = {-0x1p-40, 1, 3}, .direction = {0, 0, -1}}));
    CHECK_FALSE(quad.hit({.origin = {1, 2 + 0x1p-40, 3}, .direction = {0, 0, -1}}));
    for (const Vec3 d : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{1, 1, 0}, Vec3{1, 0, -0.0}})
        for (const Point3 o : {Point3{-1, 1, 0}, Point3{1, 1, 0}, Point3{0, 0, 0}})
            CHECK_FALSE(quad.hit({.origin = o, .direction = d}));
}

TEST_CASE("Quad: the range is open at t_min and closed at t_max", "[shape][quad]") {
    const Quad quad({0, 0, 0}, {4, 0, 0}, {0, 2, 0}, nullptr);
    const auto hits = [&](double t_min, double t_max) {
        return quad.hit({{1, 1, 8}, {0, 0, -2}, t_min, t_max, 0}).has_value();
    };
    CHECK(hits(0, 4));
    CHECK_FALSE(hits(0, std::nextafter(4, 0)));
    CHECK_FALSE(hits(4, kInfinity));
    CHECK(hits(std::nextafter(4, 0), kInfinity));
    CHECK(quad.hit({{1, 1, 0}, {0, 0, 1}, -1, 1, 0})->t == 0);
}

TEST_CASE("Quad: u and v run along the edges and the normal is edge_u x edge_v", "[shape][quad]") {
    const auto hit = Quad({1, 2, 3}, {4, 0, 0}, {1, 2, 0}, nullptr)
                         .hit({.origin = {1 + 1 + 0.75, 2 + 1.5, 8}, .direction = {0, 0, -1}});
    REQUIRE(hit);
    CHECK(hit->u == Approx(0.25));
    CHECK(hit->v == Approx(0.75));
    CHECK(hit->normal == Normal3{0, 0, 1});
}

TEST_CASE("Quad: its box contains all four corners", "[shape][quad]") {
    Random random(41);
    for (int i = 0; i < 1000; ++i) {
        const Point3 c = Point3{} + random.in_cube(random.log_uniform(1e-3, 1e6));
        const Vec3 u = random.in_cube(), v = random.in_cube();
        const Box box = Quad(c, u, v, nullptr).bounds();
        bool inside = true;
        for (const test::Real3& p : {test::Real3(c), test::Real3(c) + test::Real3(u), test::Real3(c) + test::Real3(v),
                                     test::Real3(c) + test::Real3(u) + test::Real3(v)})
            inside = inside && p.x >= test::Real(box.lower.x) && p.y >= test::Real(box.lower.y) &&
                     p.z >= test::Real(box.lower.z) && p.x <= test::Real(box.upper.x) &&
                     p.y <= test::Real(box.upper.y) && p.z <= test::Real(box.upper.z);
        CHECK(inside);
    }
}

TEST_CASE("make_box: six quads, normals outward, in the order front, right, back, left, top, bottom", "[shape][quad]") {
    const auto box = make_box({1, 4, 9}, {0, 2, 6}, nullptr);  // corners in any order
    CHECK(count_elements(*box) == 6);
    const Point3 center{0.5, 3, 7.5};
    const Vec3 outward[] = {{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    const double reach[] = {1.5, 0.5, 1.5, 0.5, 1, 1};
    for (std::size_t i = 0; i < 6; ++i) {
        const auto inside = box->hit({.origin = center, .direction = outward[i]});
        REQUIRE(inside);
        CHECK(inside->element == i);
        CHECK(inside->t == Approx(reach[i]));
        CHECK(Vec3(inside->normal) == outward[i]);
        CHECK(box->hit({.origin = center + 10 * outward[i], .direction = -outward[i]})->element == i);
    }
    CHECK(box->bounds().contains(Box{{0, 2, 6}, {1, 4, 9}}));
    CHECK_THROWS_AS(make_box({0, 0, 0}, {1, 0, 1}, nullptr), ArgumentError);
    CHECK_THROWS_AS(make_box({0, 0, 0}, {1, kInfinity, 1}, nullptr), ArgumentError);
    CHECK_THROWS_AS(make_box({0, 0, std::numeric_limits<double>::quiet_NaN()}, {1, 1, 1}, nullptr), ArgumentError);
}

TEST_CASE("make_box: no ray from inside escapes through edges and corners", "[shape][quad]") {
    Random random(42);
    const auto box = make_box({-1, -2, -3}, {3, 2, 1}, nullptr);
    Tally tally;
    for (int i = 0; i < 20000; ++i) {
        const Point3 origin = random.in_box({{-0.9, -1.9, -2.9}, {2.9, 1.9, 0.9}});
        Point3 aim{random.chance(0.5) ? -1.0 : 3.0, random.chance(0.5) ? -2.0 : 2.0, random.chance(0.5) ? -3.0 : 1.0};
        if (random.chance(0.5)) {
            const std::size_t axis = random.index(3);
            aim[axis] = random.uniform(-0.9, 0.9);
        }
        const Ray ray{.origin = origin, .direction = aim - origin};
        const auto hit = box->hit(ray);
        if (!hit || std::abs(hit->t - 1) > 1e-12) tally.fault(ray, "leak");
    }
    INFO(tally.first);
    CHECK(tally.wrong == 0);
}

TEST_CASE("Quad: an unusable ray misses", "[shape][quad]") {
    const Quad quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, nullptr);
    for (const Ray& ray : test::unusable_rays()) CHECK_FALSE(quad.hit(ray));
}
