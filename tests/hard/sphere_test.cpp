// Spheres: small and far, huge and near, at their horizon, moving.
#include "hard/hard.h"
#include "hard/shapes.h"

namespace limn::sphere_test {

using namespace test;

namespace {

constexpr double kUlp = 0x1p-23;

struct Ball {
    Point3 center;
    double radius;
};

std::shared_ptr<const Sphere> sphere_of(const Ball& b) { return std::make_shared<Sphere>(b.center, b.radius, nullptr); }

}  // namespace

TEST_CASE("Sphere: random rays, half of them degenerate, still or moving, large or small, are decided exactly",
          "[hard][sphere]") {
    Random random(510);
    struct Motion {
        Point3 at0, at1;
        double radius;
    };
    const Motion motions[] = {{{0, 0, 0}, {0, 0, 0}, 1},
                              {{3, -2, 5}, {3, -2, 5}, 0.7},
                              {{0, -1000, 0}, {0, -1000, 0}, 1000},
                              {{1e5, 2e5, -3e5}, {1e5, 2e5, -3e5}, 1e-2},
                              {{1, 2, 3}, {4, -2, 1}, 1.5},
                              {{0, 0, 0}, {0, 0, 0}, -1},
                              {{1e-9, 0, 0}, {1e-9, 0, 0}, 1e-12},
                              {{0, 0, 1e12}, {0, 1e9, 1e12}, 1e10}};
    for (const Motion& m : motions) {
        const auto sphere = std::make_shared<Sphere>(m.at0, m.at1, m.radius, nullptr);
        const double r = std::abs(m.radius);
        const BothWorlds world(sphere, company_near(random, m.at0, r));
        Targets targets{sphere->bounds(), {}};
        for (const Point3& c : {m.at0, m.at1})
            for (int i = 0; i < 8; ++i)
                targets.points.insert(targets.points.end(), {c, c + r * random.unit(), c + Vec3{r, 0, 0},
                                                             c - Vec3{0, r, 0}, c + Vec3{0, 0, r}});
        Tally tally;
        for (int i = 0; i < count(1e6); ++i) {
            const Ray ray = random_ray(random, targets);
            judge_sphere(tally, world, sphere->center(ray.time), m.radius, ray);
        }
        check(tally, "radius " + number(m.radius));
        CHECK(tally.hits > tally.rays / 8);
    }
}

TEST_CASE("Sphere: a unit sphere at 1e7 is hit at the exact t", "[hard][sphere]") {
    const BothWorlds world(sphere_of({{0, 0, 1e7}, 1}));
    Tally tally;
    CHECK(world.hit(towards({0, 0, 0}, {0, 0, 1}), tally)->t == 9999999);
    CHECK(std::abs(world.hit(towards({0, 0.5, 0}, {0, 0, 1}), tally)->t / 9999999.13397460 - 1) <= kUlp);
    CHECK(tally.wrong == 0);
}

TEST_CASE("Sphere: small and far, up to 1e9 radii away, it is decided exactly", "[hard][sphere]") {
    Random random(511);
    for (double distance = 1e2; distance < 2e9; distance *= 10) {
        Tally tally;
        for (int i = 0; i < count(1e4); ++i) {
            Ball ball{Point3{}, random.log_uniform(0.01, 100)};
            ball.center = Point3{} + distance * ball.radius * random.unit();
            const bool in_float = i % 2 == 0;
            if (in_float) ball = {to_float(ball.center), static_cast<float>(ball.radius)};
            const BothWorlds world(sphere_of(ball), company_near(random, ball.center, ball.radius));
            for (int n = 0; n < 100; ++n) {
                const Point3 aim = ball.center + random.uniform(0, 1.5) * ball.radius * random.unit();
                const Vec3 d = random.log_uniform(0.1, 10) * normalize(aim - Point3{});
                judge_sphere(tally, world, ball.center, ball.radius, towards({}, in_float ? to_float(d) : d));
            }
        }
        check(tally, "D/r = " + number(distance));
    }
}

TEST_CASE("Sphere: a ground sphere is hit at the exact t from an eye one unit above it", "[hard][sphere]") {
    const double radii[] = {1e3, 1e6, 1e7};
    const double slopes[] = {10, 100, 1000};
    const double expected[] = {1.05572982620355361, 1.00505063389623053, 1.05572809017445065};
    for (std::size_t i = 0; i < 3; ++i) {
        const Ball ball{{0, -radii[i], 0}, radii[i]};
        Tally tally;
        const Ray ray = towards({0, 1, 0}, {slopes[i], -1, 0});
        CHECK(std::abs(BothWorlds(sphere_of(ball)).hit(ray, tally)->t / expected[i] - 1) <= kUlp);
        judge_sphere(tally, BothWorlds(sphere_of(ball)), ball.center, ball.radius, ray);
        check(tally, "r = " + number(radii[i]));
    }
}

TEST_CASE("Sphere: rays to the horizon of a ground sphere are decided exactly, to a billionth of the dip",
          "[hard][sphere]") {
    Random random(512);
    for (double r = 1e3; r <= 1e7; r *= 10) {
        const Ball ground{{0, -r, 0}, r};
        const BothWorlds world(sphere_of(ground), company_near(random, {0, 1, 0}, 0.1));
        const double dip = std::acos(r / (r + 1));
        for (const double width : {1e-2, 1e-5, 1e-9}) {
            Tally tally;
            for (int i = 0; i < count(width == 1e-2 ? 1e6 : 3e5); ++i) {
                const double angle = dip * (1 + width * random.uniform(-1, 1)), around = random.uniform(0, 2 * kPi);
                const Vec3 d{std::cos(angle) * std::cos(around), -std::sin(angle), std::cos(angle) * std::sin(around)};
                judge_sphere(tally, world, ground.center, r, towards({0, 1, 0}, i % 2 ? d : to_float(d)));
            }
            check(tally, "r = " + number(r) + ", width " + number(width));
            if (width == 1e-2) CHECK((tally.hits > tally.rays * 3 / 10 && tally.hits < tally.rays * 7 / 10));
        }
    }
}

TEST_CASE("Sphere: a ray from the centre leaves through the inside of the surface", "[hard][sphere]") {
    const auto sphere = sphere_of({{1, 2, 3}, 2});
    const Ray ray = towards({1, 2, 3}, {0, 3, 4});
    CHECK(std::abs(sphere->hit(ray)->t / 0.4 - 1) <= kUlp);
    CHECK(length(Vec3(sphere->hit(ray)->normal) - Vec3{0, 0.6, 0.8}) <= 2e-7);
    Scene scene;
    scene.add(sphere);
    const CompiledScene compiled = compile(scene);
    const auto hit = compiled.closest_hit(ray);
    REQUIRE(hit);
    const Surface surface = compiled.surface_at(ray, *hit);
    CHECK_FALSE(surface.front_face);
    CHECK(length(Vec3(surface.normal) + Vec3{0, 0.6, 0.8}) <= 2e-7);
}

TEST_CASE("Sphere: u and v are between 0 and 1 and name the point, at poles and seam too", "[hard][sphere]") {
    Random random(520);
    for (const double r : {1.0, 1e-3, 1e5}) {
        Scene scene;
        scene.add(sphere_of({{0, 0, 0}, r}));
        const CompiledScene compiled = compile(scene);
        Tally tally;
        for (int i = 0; i < count(1e7 / 3); ++i) {
            Vec3 n = random.unit();
            if (i % 3 == 1) n = {1e-30 * n.x, random.sign(), 1e-18 * n.z};
            if (i % 3 == 2) n = {-1, 1e-20 * n.y, random.chance(0.5) ? 1e-30 * n.z : std::copysign(0.0, n.z)};
            const Ray ray = towards(Point3{} + random.uniform(0, 3) * r * n, (i % 2 ? -1.0 : 1.0) * n);
            const auto hit = compiled.closest_hit(ray);
            ++tally.rays, ++tally.judged;
            if (!hit) continue;
            const Uv uv = compiled.surface_at(ray, *hit).uv;
            const Vec3 p = (1 / r) * (ray.at(hit->t) - Point3{});
            const double around = 2 * kPi * uv.u, down = kPi * uv.v, s = std::sin(down);
            const Vec3 named{-s * std::cos(around), -std::cos(down), s * std::sin(around)};
            if (!(uv.u >= 0 && uv.u <= 1 && uv.v >= 0 && uv.v <= 1)) tally.fault(ray, "outside");
            if (!(length(named - p) <= 1e-7)) tally.fault(ray, "another point");  // acos near a pole: sqrt(2^-53)
        }
        check(tally, "r = " + number(r));
    }
}

}  // namespace limn::sphere_test
