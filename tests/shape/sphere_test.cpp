// Agreement with the exact answer is asked for wherever plain double can decide: see support/truth.h for the margin.
#include "limn/shape/sphere.h"

#include "catch.h"
#include "limn/core/error.h"
#include "support/random_geometry.h"
#include "support/truth.h"

using namespace limn;
using limn::test::Random;
using limn::test::Tally;

namespace {

constexpr double kUlp = 0x1p-23;  // one float ulp, the unit of every tolerance on t

Tally judge_rays(const Sphere& sphere, const std::vector<Ray>& rays) {
    Tally tally;
    for (const Ray& ray : rays) {
        const auto hit = sphere.hit(ray);
        judge(tally, ray, test::true_sphere_hit(sphere.center(ray.time), sphere.radius(), ray), hit);
        if (!hit) continue;
        const Vec3 n(hit->normal);
        if (!(std::abs(length(n) - 1) <= gamma(8)) || !(hit->u >= 0 && hit->u <= 1 && hit->v >= 0 && hit->v <= 1))
            tally.fault(ray, "normal, u or v");
    }
    return tally;
}

Ray towards(const Point3& origin, const Vec3& direction) { return {.origin = origin, .direction = direction}; }

double relative(double t, double expected) { return std::abs(t - expected) / std::abs(expected); }

}  // namespace

TEST_CASE("Sphere: hits what exact arithmetic hits, at the same t, on random and degenerate rays", "[shape][sphere]") {
    Random random(20);
    struct Kind {
        Point3 center0, center1;
        double radius;
    };
    const Kind kinds[] = {{{0, 0, 0}, {0, 0, 0}, 1},
                          {{3, -2, 5}, {3, -2, 5}, 0.7},
                          {{0, -1000, 0}, {0, -1000, 0}, 1000},
                          {{1e5, 2e5, -3e5}, {1e5, 2e5, -3e5}, 1e-2},
                          {{1, 2, 3}, {4, -2, 1}, 1.5},
                          {{0, 0, 0}, {0, 0, 0}, -1},
                          {{1e-9, 0, 0}, {1e-9, 0, 0}, 1e-12},
                          {{0, 0, 1e12}, {0, 1e9, 1e12}, 1e10}};
    for (const Kind& kind : kinds) {
        const Sphere sphere(kind.center0, kind.center1, kind.radius, nullptr);
        test::Targets targets{sphere.bounds(), {}};
        const double r = std::abs(kind.radius);
        for (const Point3& c : {kind.center0, kind.center1}) {
            targets.points.push_back(c);
            for (const double s : {-1.0, 1.0})
                for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
                    targets.points.push_back(c + s * r * axis);
            for (int i = 0; i < 8; ++i) targets.points.push_back(c + r * random.unit());
        }
        std::vector<Ray> rays(15000);
        for (Ray& ray : rays) ray = random_ray(random, targets);
        const Tally tally = judge_rays(sphere, rays);
        INFO("radius " << kind.radius << ": " << tally.first);
        CHECK(tally.wrong == 0);
        CHECK(tally.judged > tally.rays / 2);  // the rest are tangents and ends of the range on purpose
        CHECK(tally.hits > tally.rays / 8);
    }
}

TEST_CASE("Sphere: t of a distant unit sphere is exact", "[shape][sphere]") {
    const Sphere sphere({0, 0, 1e7}, 1, nullptr);
    CHECK(sphere.hit(towards({0, 0, 0}, {0, 0, 1}))->t == 9999999);
    CHECK(relative(sphere.hit(towards({0, 0.5, 0}, {0, 0, 1}))->t, 9999999.13397460) <= kUlp);
}

TEST_CASE("Sphere: small and far, up to 1e7 radii away, decided as exact arithmetic does", "[shape][sphere]") {
    Random random(21);
    for (double distance = 1e2; distance <= 1e7; distance *= 10) {
        Tally tally;
        for (int i = 0; i < 10000; ++i) {
            const double radius = random.log_uniform(0.01, 100);
            const Sphere sphere(Point3{} + distance * radius * random.unit(), radius, nullptr);
            const Point3 aim = sphere.center(0) + random.uniform(0, 1.5) * radius * random.unit();
            const Ray ray = towards({}, random.log_uniform(0.1, 10) * normalize(aim - Point3{}));
            judge(tally, ray, test::true_sphere_hit(sphere.center(0), radius, ray), sphere.hit(ray));
        }
        INFO("D/r = " << distance << ": " << tally.first);
        CHECK(tally.wrong == 0);
        CHECK(tally.judged >= tally.rays * 999 / 1000);
    }
}

TEST_CASE("Sphere: a ground sphere is right from an eye one unit above it", "[shape][sphere]") {
    const double radii[] = {1e3, 1e6, 1e7};
    const double slopes[] = {10, 100, 1000};
    const double expected[] = {1.05572982620355361, 1.00505063389623053, 1.05572809017445065};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto hit = Sphere({0, -radii[i], 0}, radii[i], nullptr).hit(towards({0, 1, 0}, {slopes[i], -1, 0}));
        REQUIRE(hit);
        CHECK(relative(hit->t, expected[i]) <= kUlp);
    }
}

TEST_CASE("Sphere: rays to the horizon of a ground sphere are decided as exact arithmetic does", "[shape][sphere]") {
    Random random(22);
    for (double r = 1e3; r <= 1e7; r *= 10) {
        const Sphere ground({0, -r, 0}, r, nullptr);
        const double dip = std::acos(r / (r + 1));
        Tally tally;
        for (int i = 0; i < 10000; ++i) {
            const double angle = dip * random.uniform(0.99, 1.01), around = random.uniform(0, 2 * kPi);
            const Vec3 d{std::cos(angle) * std::cos(around), -std::sin(angle), std::cos(angle) * std::sin(around)};
            const Ray ray = towards({0, 1, 0}, d);
            judge(tally, ray, test::true_sphere_hit({0, -r, 0}, r, ray), ground.hit(ray), r <= 1e6 ? 2 : 32);
        }
        INFO("r = " << r << ": " << tally.first);
        CHECK(tally.wrong == 0);
        CHECK(tally.judged >= tally.rays * 99 / 100);
        CHECK((tally.hits > 3000 && tally.hits < 7000));
    }
}

TEST_CASE("Sphere: a ray from the centre leaves through the inside of the surface", "[shape][sphere]") {
    const auto hit = Sphere({1, 2, 3}, 2, nullptr).hit(towards({1, 2, 3}, {0, 3, 4}));
    REQUIRE(hit);
    CHECK(relative(hit->t, 0.4) <= kUlp);
    CHECK(length(Vec3(hit->normal) - Vec3{0, 0.6, 0.8}) <= 2e-7);
}

TEST_CASE("Sphere: the length of the direction only scales t, from 1e-30 to 1e25", "[shape][sphere]") {
    const Sphere sphere({0, 0, 10}, 1, nullptr);
    for (int k = -30; k <= 25; ++k) {
        const double s = std::pow(10.0, k);
        const auto hit = sphere.hit(towards({0, 0, 0}, {0, 0, s}));
        REQUIRE(hit);
        CHECK(relative(hit->t * s, 9) <= 2 * kUlp);
        CHECK_FALSE(sphere.hit(towards({0, 1.01, 0}, {0, 0, s})));
        CHECK_FALSE(sphere.hit(towards({0, 0, 0}, {0, 0, -s})));
    }
    for (const double scale : {1e-200, 1e-160, 1e160, 1e200}) {  // where squares of lengths leave the range of double
        const auto hit = Sphere({0, 0, 10 * scale}, scale, nullptr).hit(towards({0, 0, 0}, {0, 0, scale}));
        REQUIRE(hit);
        CHECK(relative(hit->t, 9) <= kUlp);
        const auto out = Sphere({0, 0, 0}, scale, nullptr).hit(towards({0, 0, 0}, {0, 0, 1}));  // from the centre
        REQUIRE(out);
        CHECK(relative(out->t, scale) <= kUlp);
    }
}

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
    CHECK(relative(far->t, 3) <= kUlp);
}
