#include "geometry/bvh/slab.h"

#include <array>
#include <cstdlib>
#include <limits>
#include <optional>
#include <random>

#include "catch.h"
#include "limn/math/box.h"
#include "property.h"
#include "support/grid.h"

namespace limn::slab_test {

namespace {

bool meets(const Box& box, const Ray& ray, double origin_error = 0, double direction_error = 0) {
    double near = 0;
    return accel::SlabRay(ray, accel::finite_extent(box), origin_error, direction_error).meets(box, ray.t_max, near);
}

bool meets_as_float(const Box& box, const Ray& ray) {
    const auto f = [](double x) { return static_cast<float>(x); };
    const float lower[3] = {f(box.lower.x), f(box.lower.y), f(box.lower.z)};
    const float upper[3] = {f(box.upper.x), f(box.upper.y), f(box.upper.z)};
    double near = 0;
    return accel::SlabRay(ray, accel::finite_extent(box)).meets(lower, upper, ray.t_max, near);
}

const Box kUnit{{0, 0, 0}, {1, 1, 1}};

// Where the ray enters the box; nothing where it misses.
std::optional<double> entry(const Box& box, const Ray& ray) {
    double near = 0;
    const bool met = accel::SlabRay(ray, accel::finite_extent(box)).meets(box, ray.t_max, near);
    return met ? std::optional(near) : std::nullopt;
}

struct Case {
    Box box;
    Ray ray;
};

Case draw_case() {
    Case c;
    c.box.extend(test::draw_point());
    c.box.extend(test::draw_point());
    c.ray.origin = test::draw_point();
    c.ray.direction = c.box.center() + 0.5 * test::draw_vec() - c.ray.origin;
    RC_PRE(!(c.ray.direction == Vec3{}));
    if (test::draw_int(0, 1)) c.ray.t_min = test::draw_int(-64, 64) / 64.0;
    if (test::draw_int(0, 1)) c.ray.t_max = std::max(c.ray.t_min, test::draw_int(0, 128) / 64.0);
    return c;
}

// Along each axis at an end of the box, or a quarter, a half or three quarters on.
Point3 draw_point_of(const Box& box) {
    Point3 p;
    for (std::size_t a = 0; a < 3; ++a)
        p[a] = box.lower[a] + test::draw_int(0, 4) / 4.0 * (box.upper[a] - box.lower[a]);
    return p;
}

}  // namespace

TEST_CASE("Slab: a direction 2^k times as long changes nothing but the unit of t, to the bit", "[accel]") {
    test::holds(
        [] {
            const Case c = draw_case();
            const double s = test::draw_power_of_two(-300, 300);
            Ray longer = c.ray;
            longer.direction = s * c.ray.direction;
            longer.t_min = c.ray.t_min / s, longer.t_max = c.ray.t_max / s;
            const auto a = entry(c.box, c.ray), b = entry(c.box, longer);
            RC_ASSERT(a.has_value() == b.has_value());
            RC_ASSERT((!a || *a == s * *b));
        },
        1000);
}

TEST_CASE("Slab: in a world 2^k times as large everything is 2^k times as large, to the bit", "[accel]") {
    test::holds(
        [] {
            const Case c = draw_case();
            const double s = test::draw_power_of_two(-300, 300);
            const auto scaled = [&](const Point3& p) { return Point3{} + s * (p - Point3{}); };
            Ray larger = c.ray;
            larger.origin = scaled(c.ray.origin);
            larger.t_min = s * c.ray.t_min, larger.t_max = s * c.ray.t_max;
            const auto a = entry(c.box, c.ray), b = entry({scaled(c.box.lower), scaled(c.box.upper)}, larger);
            RC_ASSERT(a.has_value() == b.has_value());
            RC_ASSERT((!a || s * *a == *b));
        },
        1000);
}

TEST_CASE("Slab: axes may change their names and signs", "[accel]") {
    test::holds(
        [] {
            const Case c = draw_case();
            const auto turned = [axis = static_cast<std::size_t>(test::draw_int(0, 2)), turn = test::draw_int(0, 2),
                                 mirror = test::draw_int(0, 1)](Vec3 v) {
                if (mirror) v[axis] = -v[axis];
                for (int i = 0; i < turn; ++i) v = {v.y, v.z, v.x};
                return v;
            };
            Case other = c;
            other.box = {};
            for (const Point3& p : {c.box.lower, c.box.upper}) other.box.extend(Point3{} + turned(p - Point3{}));
            other.ray.origin = Point3{} + turned(c.ray.origin - Point3{});
            other.ray.direction = turned(c.ray.direction);
            RC_ASSERT(entry(c.box, c.ray) == entry(other.box, other.ray));
        },
        1000);
}

TEST_CASE("Slab: a ray that ends in a box, on its border, or begins there, meets it", "[accel]") {
    test::holds(
        [] {
            Case c = draw_case();
            c.ray.direction = (draw_point_of(c.box) - c.ray.origin) / 3;  // rounded: the end is off by an ulp or two
            c.ray.t_min = 0, c.ray.t_max = 3;
            RC_ASSERT(entry(c.box, c.ray));
            c.ray.t_min = 3, c.ray.t_max = kInfinity;
            RC_ASSERT(entry(c.box, c.ray));
        },
        1000);
}

TEST_CASE("Slab: what meets a box meets every box around it, no later, and by a longer range as well", "[accel]") {
    int met = 0;
    test::holds(
        [&] {
            const Case c = draw_case();
            const auto inner = entry(c.box, c.ray);
            if (!inner) return;
            ++met;
            Box around = c.box;
            around.extend(test::draw_point());
            const auto outer = entry(around, c.ray);
            RC_ASSERT((outer && *outer <= *inner));
            Ray longer = c.ray;
            longer.t_max = c.ray.t_max + 1;
            RC_ASSERT(entry(c.box, longer) == inner);
            longer.t_min = c.ray.t_min - 1;
            RC_ASSERT((entry(c.box, longer) && *entry(c.box, longer) <= *inner));
            // It enters where the ray is at the box, or at t_min, but for 2^-30 of the coordinates.
            const Point3 at = c.ray.at(*inner);
            const double slack = 4 * 0x1p-30 * 64;
            RC_ASSERT(grow(c.box, {slack, slack, slack}).contains(at));
            const Ray until{c.ray.origin, c.ray.direction, -kInfinity, *inner - slack / max_abs(c.ray.direction), 0};
            RC_ASSERT((*inner <= c.ray.t_min || !entry(c.box, until)));
        },
        1000);
    CHECK(met > 250);
}

// As those of a ray inside an instance are.
TEST_CASE("Slab: a ray whose numbers are off by what it says meets what the true ray meets, where that does",
          "[accel]") {
    test::holds(
        [] {
            const Case c = draw_case();
            const Vec3 direction = draw_point_of(c.box) - c.ray.origin;
            const double length = max_abs(direction);
            RC_PRE(length > 0);
            const double origin_error = test::draw_power_of_two(-20, 2);
            const double direction_error = test::draw_power_of_two(-20, -4) * length;
            Ray off{.origin = c.ray.origin, .direction = direction, .t_min = 1, .t_max = 1};  // ends in the box
            for (std::size_t a = 0; a < 3; ++a) {
                off.origin[a] += test::draw_int(-1, 1) * origin_error;
                off.direction[a] += test::draw_int(-1, 1) * direction_error;
            }
            RC_ASSERT(meets(c.box, off, origin_error, direction_error));
        },
        1000);
}

TEST_CASE("Slab: a ray in a face, an edge or through a corner meets the closed box", "[accel]") {
    for (const double zero : {0.0, -0.0}) {
        CHECK(meets(kUnit, {{-1, 0.5, 0}, {1, zero, zero}}));  // in the low z face
        CHECK(meets(kUnit, {{-1, 0.5, 1}, {1, zero, zero}}));  // in the high z face
        CHECK(meets(kUnit, {{-1, 0, 0}, {1, zero, zero}}));    // along an edge
        CHECK(meets(kUnit, {{-1, 1, 1}, {1, zero, zero}}));
        CHECK(meets(kUnit, {{0, 0.5, 0.5}, {zero, 1, zero}}));  // from a face, within it
        CHECK(meets(kUnit, {{1, 0.5, 0.5}, {1, zero, zero}}));  // from a face, leaving
        CHECK_FALSE(meets(kUnit, {{-1, 1.0000001, 0}, {1, zero, zero}}));
        CHECK_FALSE(meets(kUnit, {{-1, -1e-7, 0}, {1, zero, zero}}));
    }
    CHECK(meets(kUnit, {{-1, -1, -1}, {1, 1, 1}}));
    CHECK(meets(kUnit, {{-1, 0, 1}, {1, 0.5, -0.5}}));
}

TEST_CASE("Slab: flat boxes and points are met", "[accel]") {
    const Box flat{{0, 0, 1e5}, {1, 1, 1e5}}, point{{1, 2, 3}, {1, 2, 3}};
    CHECK(meets(flat, {{0.5, 0.5, 0}, {0, 0, 1}}));
    CHECK(meets(flat, {{0.5, 0.5, 1e5}, {0, 0, 1}}));
    CHECK(meets(flat, {{-1, 0.5, 1e5}, {1, 0, 0}}));
    CHECK(meets(point, {{0, 2, 3}, {1, 0, 0}}));
    CHECK(meets(point, {{0, 0, 0}, {1, 2, 3}}));
    CHECK_FALSE(meets(point, {{0, 0, 0}, {1, 2, 3.0000001}}));
}

TEST_CASE("Slab: the interval of the ray counts, closed at t_max", "[accel]") {
    CHECK(meets(kUnit, {{-1, 0.5, 0.5}, {1, 0, 0}, 0, 1}));
    CHECK_FALSE(meets(kUnit, {{-1, 0.5, 0.5}, {1, 0, 0}, 0, 0.999}));
    CHECK_FALSE(meets(kUnit, {{-1, 0.5, 0.5}, {1, 0, 0}, 2.001, 10}));
    CHECK(
        meets(kUnit, {{3, 0.5, 0.5}, {1, 0, 0}, -kInfinity, 0}));  // behind the origin, and the interval reaches there
}

TEST_CASE("Slab: an empty box is never met", "[accel]") {
    const Box empty;
    for (const double x : {1.0, -1.0, 0.0, -0.0})
        for (const double y : {1.0, -1.0}) {
            CHECK_FALSE(meets(empty, {{0.1, 0.2, 0.3}, {x, y, 0.5}}));
            CHECK_FALSE(meets_as_float(empty, {{0.1, 0.2, 0.3}, {x, y, 0.5}}));
        }
}

// Truth in __float128 on the same numbers.
TEST_CASE("Slab: no ray that meets a box in exact arithmetic is lost, at corners and edges, near and far", "[accel]") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    const int rays = std::getenv("LIMN_FULL") ? 10'000'000 : 100'000;
    int lost = 0, judged = 0;
    for (int i = 0; i < rays; ++i) {
        const std::array<double, 3> places{0, 1e3, 1e5};
        const std::array<double, 2> sizes{1, 1e-3};
        const double place = places[random() % 3], size = sizes[random() % 2];
        Box box;
        for (std::size_t a = 0; a < 3; ++a) {
            box.lower[a] = static_cast<float>(place + size * unit(random));
            box.upper[a] = static_cast<float>(box.lower[a] + size * unit(random));
        }
        Point3 target;
        for (std::size_t a = 0; a < 3; ++a)
            target[a] = random() % 4 == 0   ? box.lower[a] + unit(random) * (box.upper[a] - box.lower[a])
                        : random() % 2 == 0 ? box.lower[a]
                                            : box.upper[a];
        Ray ray;
        for (std::size_t a = 0; a < 3; ++a) ray.origin[a] = place + 10 * size * (unit(random) - 0.5);
        ray.direction = target - ray.origin;
        __float128 enter = 0, leave = std::numeric_limits<double>::max();
        bool meets_exactly = true;
        for (std::size_t a = 0; a < 3; ++a) {
            const __float128 o = ray.origin[a], d = ray.direction[a];
            if (d == 0) {
                meets_exactly = meets_exactly && o >= box.lower[a] && o <= box.upper[a];
                continue;
            }
            const __float128 t0 = (box.lower[a] - o) / d, t1 = (box.upper[a] - o) / d;
            const __float128 lo = t0 < t1 ? t0 : t1, hi = t0 < t1 ? t1 : t0;
            enter = lo > enter ? lo : enter;
            leave = hi < leave ? hi : leave;
        }
        if (!meets_exactly || enter > leave) continue;
        ++judged;
        lost += meets_as_float(box, ray) ? 0 : 1;
    }
    CHECK(judged > rays / 10);
    CHECK(lost == 0);
}

TEST_CASE("Slab: the interval and the box are wider by the rounding of hits, relative to the coordinates", "[accel]") {
    for (const double scale : {1.0, 1e6, 1e-6}) {
        const Box box{{0, 0, 0}, {scale, scale, scale}};
        const Point3 outside{-scale, scale / 2, scale / 2};
        const Vec3 towards{scale, 0, 0};
        CHECK(meets(box, {outside, towards, 0, 1 - 1e-10}));
        CHECK(meets(box, {outside, towards, 2 + 1e-10, 3}));
        CHECK(meets(box, {{-scale, scale * (1 + 1e-10), 0}, towards}));
        CHECK_FALSE(meets(box, {outside, towards, 0, 1 - 1e-7}));
        CHECK_FALSE(meets(box, {outside, towards, 2 + 1e-7, 3}));
        CHECK_FALSE(meets(box, {{-scale, scale * (1 + 1e-7), 0}, towards}));
    }
}

}  // namespace limn::slab_test
