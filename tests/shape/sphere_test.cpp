#include "limn/scene/shape/sphere.h"

#include "catch.h"
#include "limn/math/error.h"
#include "support/random_geometry.h"
#include "support/real.h"

namespace limn::sphere_test {

using limn::test::Random;

namespace {

Ray towards(const Point3& origin, const Vec3& direction) { return {.origin = origin, .direction = direction}; }

}  // namespace

TEST_CASE("Sphere: the range is open at t_min and closed at t_max", "[shape][sphere]") {
    const Sphere sphere({0, 0, 10}, 2, nullptr);  // roots 8 and 12
    const auto t_of = [&](double t_min, double t_max) -> double {
        const auto hit = sphere.hit({{0, 0, 0}, {0, 0, 1}, t_min, t_max, 0});
        return hit ? hit->t : kInfinity;
    };
    CHECK(t_of(0, kInfinity) == 8);
    CHECK(t_of(8, kInfinity) == 12);
    CHECK(t_of(std::nextafter(8, 0), kInfinity) == 8);
    CHECK(t_of(9, kInfinity) == 12);
    CHECK(t_of(9, 12) == 12);
    CHECK(t_of(9, std::nextafter(12, 0)) == kInfinity);
    CHECK(t_of(12, kInfinity) == kInfinity);
    CHECK(t_of(0, 8) == 8);
    CHECK(t_of(0, std::nextafter(8, 0)) == kInfinity);
    CHECK(t_of(8, 8) == kInfinity);
    CHECK(t_of(-kInfinity, kInfinity) == 8);
    CHECK(sphere.hit({{0, 0, 20}, {0, 0, 1}, -kInfinity, 0, 0})->t == -12);
}

TEST_CASE("Sphere: it is a closed set, a tangent is a hit", "[shape][sphere]") {
    for (const double r : {1.0, 0.5, 1024.0, 0x1p-30}) {  // every step is exact here
        const auto hit = Sphere({0, 0, 0}, r, nullptr).hit(towards({r, -4 * r, 0}, {0, r, 0}));
        REQUIRE(hit);
        CHECK(hit->t == 4);
        CHECK_FALSE(Sphere({0, 0, 0}, r, nullptr).hit(towards({r * (1 + 1e-12), -4 * r, 0}, {0, r, 0})));
    }
}

TEST_CASE("Sphere: a zero, NaN or infinite number is refused by name", "[shape][sphere]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double radius : {0.0, -0.0, nan, kInfinity, -kInfinity}) {
        CHECK_THROWS_AS(Sphere({0, 0, 0}, radius, nullptr), ArgumentError);
        CHECK_THROWS_WITH(Sphere({0, 0, 0}, radius, nullptr), Catch::Contains("radius"));
    }
    for (const double bad : {nan, kInfinity}) {
        CHECK_THROWS_WITH(Sphere({0, bad, 0}, 1, nullptr), Catch::Contains("cent"));
        CHECK_THROWS_AS(Sphere({0, 0, 0}, {bad, 0, 0}, 1, nullptr), ArgumentError);
    }
    const Sphere tiny({0, 0, 0}, 1e-45, nullptr);
    CHECK(tiny.hit(towards({0, 0, 1e-44}, {0, 0, -1e-44})));
    CHECK(is_finite(tiny.bounds().lower));
}

TEST_CASE("Sphere: a negative radius turns the normal, and nothing else", "[shape][sphere]") {
    Random random(23);
    const Sphere out({1, 2, 3}, 0.5, nullptr), in({1, 2, 3}, -0.5, nullptr);
    CHECK(in.bounds() == out.bounds());
    for (int i = 0; i < 1000; ++i) {
        const Point3 origin = Point3{1, 2, 3} + random.in_cube(2);
        const Ray ray = towards(origin, Point3{1, 2, 3} + 0.4 * random.unit() - origin);
        const auto a = out.hit(ray), b = in.hit(ray);
        REQUIRE(a.has_value() == b.has_value());
        if (!a) continue;
        CHECK(a->t == b->t);
        CHECK(a->normal == -b->normal);
        CHECK(dot(a->normal, ray.at(a->t) - Point3{1, 2, 3}) > 0);
    }
}

TEST_CASE("Sphere: u runs around from -x through +z, v from -y to +y, finite at poles and seam", "[shape][sphere]") {
    const auto uv_at = [](const Vec3& n) {
        const auto hit = Sphere({0, 0, 0}, 2, nullptr).hit(towards(Point3{} + 5 * n, -n));
        return Uv{hit->u, hit->v};
    };
    CHECK(uv_at({1, 0, 0}).u == Approx(0.5));
    CHECK(uv_at({0, 0, 1}).u == Approx(0.25));
    CHECK(uv_at({0, 0, -1}).u == Approx(0.75));
    CHECK(uv_at({1, 0, 0}).v == Approx(0.5));
    CHECK(uv_at({0, 1, 0}).v == Approx(1));
    CHECK(uv_at({0, -1, 0}).v == Approx(0).margin(1e-12));
    const double u_at_seam = uv_at({-1, 0, 0}).u;
    CHECK((u_at_seam == Approx(0).margin(1e-12) || u_at_seam == Approx(1)));

    const Sphere sphere({0, 0, 0}, 3, nullptr);
    Random random(24);
    bool all_inside = true;
    for (int i = 0; i < 100000; ++i) {
        Vec3 n = random.unit();
        if (i % 3 == 1) n = {1e-30 * n.x, random.sign(), 1e-18 * n.z};
        if (i % 3 == 2) n = {-1, 1e-20 * n.y, 1e-30 * n.z};
        const auto hit = sphere.hit(towards(Point3{} + random.uniform(0, 9) * n, (i % 2 ? -1.0 : 1.0) * n));
        all_inside = all_inside && (!hit || (hit->u >= 0 && hit->u <= 1 && hit->v >= 0 && hit->v <= 1));
    }
    CHECK(all_inside);
}

TEST_CASE("Sphere: a moving centre is bit-exact at both ends and clamped outside the shutter", "[shape][sphere]") {
    Random random(25);
    int trembling = 0;
    for (int i = 0; i < 1000; ++i) {
        const Point3 a = Point3{} + random.in_cube(random.log_uniform(1, 1e9)), b = Point3{} + random.in_cube(10);
        const Sphere sphere(a, b, 1, nullptr);
        CHECK((sphere.center(0) == a && sphere.center(1) == b));
        CHECK((sphere.center(-5) == a && sphere.center(5) == b));
        const double time = random.uniform();
        trembling += !(Sphere(a, 1, nullptr).center(time) == a);
        const Ray ray{.origin = a + Vec3{0, 0, 5}, .direction = {0, 0, -1}, .time = 0};
        CHECK(sphere.hit(ray)->t == Sphere(a, 1, nullptr).hit(ray)->t);
    }
    CHECK(trembling == 0);  // a still sphere is where it is at every time
}

TEST_CASE("Sphere: its box contains the exact moving sphere at every time", "[shape][sphere]") {
    Random random(26);
    std::uint64_t outside = 0;
    for (int motion = 0; motion < 1000; ++motion) {
        const double scale = random.log_uniform(1e-6, 1e9);
        const Point3 a = Point3{} + random.in_cube(scale),
                     b = random.chance(0.2) ? a : Point3{} + random.in_cube(scale);
        const double r = random.sign() * random.log_uniform(1e-9, 10) * scale;
        const Sphere sphere(a, b, r, nullptr);
        const Box box = sphere.bounds();
        for (int i = 0; i < 100; ++i) {
            const Point3 c = sphere.center(i < 50 ? i / 49.0 : random.uniform());
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (test::Real(c[axis]) - test::Real(std::abs(r)) < test::Real(box.lower[axis]) ||
                    test::Real(c[axis]) + test::Real(std::abs(r)) > test::Real(box.upper[axis]))
                    ++outside;
        }
    }
    CHECK(outside == 0);
}

TEST_CASE("Sphere: an unusable ray misses", "[shape][sphere]") {
    const Sphere sphere({0, 0, 0}, 1, nullptr), moving({0, 0, 0}, {0, 0, 1}, 1, nullptr);
    for (const Ray& ray : test::unusable_rays()) {
        CHECK_FALSE(sphere.hit(ray));
        CHECK_FALSE(moving.hit(ray));
    }
    // Far origins and -infinity as t_min are ordinary.
    const auto far = sphere.hit({{3e38, 0, 0}, {-1e38, 0, 0}, -kInfinity, kInfinity, 0});
    REQUIRE(far);
    CHECK(far->t == Approx(3));
}

}  // namespace limn::sphere_test
