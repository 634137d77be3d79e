#include "io/polygon.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "catch.h"
#include "geometry/mesh_triangle.h"
#include "limn/math/math.h"

namespace limn::polygon_test {

namespace {

using Polygon = std::vector<Float3>;

std::vector<Index3> cut(const Polygon& polygon) {
    PolygonCutter cutter;
    std::vector<Index3> triangles;
    REQUIRE(cutter.cut(polygon, triangles));
    return triangles;
}

Vec3 area_vector(const Polygon& p, const Index3& t) {
    return 0.5 * cross(to_point(p[t.b]) - to_point(p[t.a]), to_point(p[t.c]) - to_point(p[t.a]));
}

// Triangles that cover a polygon without overlap have its area together, all turn its way, and use all its corners.
void check_covers(const Polygon& polygon) {
    const std::vector<Index3> triangles = cut(polygon);
    CHECK(triangles.size() == polygon.size() - 2);
    const Vec3 whole = 0.5 * newell_normal(polygon);
    double sum = 0;
    std::set<std::uint32_t> used;
    for (const Index3& t : triangles) {
        sum += length(area_vector(polygon, t));
        CHECK(dot(area_vector(polygon, t), whole) >= 0);
        used.insert({t.a, t.b, t.c});
    }
    CHECK(sum == Approx(length(whole)).epsilon(1e-12));
    CHECK(used.size() == polygon.size());
}

// As it is, from every first corner, and from behind.
void check_covers_all_ways(Polygon polygon) {
    for (int side = 0; side < 2; ++side) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            check_covers(polygon);
            std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
        }
        std::reverse(polygon.begin(), polygon.end());
    }
}

}  // namespace

TEST_CASE("Polygon: a quadrilateral is cut between its first and third corner", "[io][polygon]") {
    CHECK(cut({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) == std::vector<Index3>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("Polygon: concave ones are covered without overlap, in any plane", "[io][polygon]") {
    const Polygon dented{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.2f, 0}, {0, 2, 0}};
    CHECK(length(newell_normal(dented)) / 2 == Approx(2.2).epsilon(1e-7));
    check_covers_all_ways(dented);
    Polygon upright = dented, across = dented;
    for (Float3& p : upright) p = {0, p.x, p.y};
    for (Float3& p : across) p = {p.y, 3, p.x};
    check_covers_all_ways(upright);
    check_covers_all_ways(across);
    check_covers_all_ways({{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5f, 1, 0}});  // an arrow
    check_covers_all_ways(
        {{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 3, 0}, {4, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});  // U
}

TEST_CASE("Polygon: corners within a straight edge are used, so that neighbours stay joined", "[io][polygon]") {
    const Polygon square{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}};
    check_covers_all_ways(square);
    for (const Index3& t : cut(square)) CHECK(length(area_vector(square, t)) > 0);
}

TEST_CASE("Polygon: a hole that a cut leads to stays open", "[io][polygon]") {
    check_covers_all_ways(
        {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}});
}

TEST_CASE("Polygon: repeated corners do not disturb the others", "[io][polygon]") {
    check_covers_all_ways({{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 0, 0}, {0, 2, 0}});
}

TEST_CASE("Polygon: size does not matter, from 1e-30 to 1e30", "[io][polygon]") {
    const float size = GENERATE(1e-30f, 1e-6f, 1e6f, 1e30f);
    Polygon arrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5f, 1, 0}};
    for (Float3& p : arrow) p = {size * p.x, size * p.y, size * p.z};
    CHECK(cut(arrow) == std::vector<Index3>{{1, 2, 3}, {0, 1, 3}});
}

TEST_CASE("Polygon: random stars are covered without overlap", "[io][polygon]") {
    std::mt19937 generator(11);
    std::uniform_real_distribution<double> radius(0.1, 1);
    for (int i = 0; i < 300; ++i) {
        const int corners = 4 + i % 60;
        Polygon star;
        for (int k = 0; k < corners; ++k) {
            const double r = radius(generator), angle = 2 * kPi * k / corners;
            star.push_back({static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)), 0});
        }
        check_covers(star);
    }
}

TEST_CASE("Polygon: one that crosses itself or has no area still gives its number of triangles", "[io][polygon]") {
    CHECK(cut({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size() == 2);
    CHECK(cut({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}}).size() == 3);
    CHECK(cut({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}).size() == 2);
    std::mt19937 generator(5);
    std::uniform_real_distribution<float> any(0, 1);
    for (std::size_t corners = 4; corners < 200; ++corners) {
        Polygon tangle;
        for (std::size_t i = 0; i < corners; ++i) tangle.push_back({any(generator), any(generator), any(generator)});
        const std::vector<Index3> triangles = cut(tangle);
        CHECK(triangles.size() == corners - 2);
        for (const Index3& t : triangles) REQUIRE(std::max({t.a, t.b, t.c}) < corners);
    }
}

TEST_CASE("Polygon: 300,000 corners around a circle are cut", "[io][polygon]") {
    Polygon circle;
    for (int i = 0; i < 300'000; ++i) {
        const double angle = 2 * kPi * i / 300'000;
        circle.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
    }
    double sum = 0;
    for (const Index3& t : cut(circle)) sum += length(area_vector(circle, t));
    CHECK(sum == Approx(length(newell_normal(circle)) / 2).epsilon(1e-9));
}

}  // namespace limn::polygon_test
