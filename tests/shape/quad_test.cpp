#include "limn/scene/shape/quad.h"

#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/shape/hittable_list.h"
#include "support/random_geometry.h"
#include "support/real.h"

namespace limn::quad_test {

using limn::test::Random;

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

TEST_CASE("Quad: an unusable ray misses", "[shape][quad]") {
    const Quad quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, nullptr);
    for (const Ray& ray : test::unusable_rays()) CHECK_FALSE(quad.hit(ray));
}

}  // namespace limn::quad_test
