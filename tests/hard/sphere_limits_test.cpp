// Spheres where a decision has no room: tangents, roots as ends of the interval, the ends of double.
#include "hard/hard.h"
#include "hard/shapes.h"

namespace limn::sphere_limits_test {

using namespace test;
using test::scaled;

namespace {

constexpr double kUlp = 0x1p-23;

struct Ball {
    Point3 center;
    double radius;
};

std::shared_ptr<const Sphere> sphere_of(const Ball& b) { return std::make_shared<Sphere>(b.center, b.radius, nullptr); }

Ball scaled(const Ball& b, int size) { return {test::scaled(b.center, size), std::ldexp(b.radius, size)}; }

// Whole vectors of whole length.
constexpr struct {
    double x, y, z, length;
} kWhole[] = {{1, 2, 2, 3},    {2, 3, 6, 7},      {1, 4, 8, 9},    {4, 4, 7, 9},      {2, 6, 9, 11},
              {3, 4, 12, 13},  {0, 3, 4, 5},      {8, 9, 12, 17},  {12, 15, 16, 25},  {0, 0, 1, 1},
              {0, 20, 21, 29}, {36, 48, 80, 100}, {6, 13, 18, 23}, {0, 119, 120, 169}};

struct Tangent {
    Ball ball;
    Vec3 outward;  // from the centre to the point of contact
    Ray ray;       // touches at t == times
    double times;
};

// A ray of whole numbers that touches a sphere of whole numbers.
Tangent whole_tangent(Random& random) {
    const auto whole = [&](int limit) {
        return static_cast<double>(random.index(2 * static_cast<std::size_t>(limit) + 1)) - limit;
    };
    const auto w = kWhole[random.index(std::size(kWhole))];
    const double sizes[] = {w.x, w.y, w.z};
    const std::size_t turn = random.index(3);
    Vec3 n;
    for (std::size_t a = 0; a < 3; ++a) n[a] = random.sign() * sizes[(a + turn) % 3];
    Vec3 d{};
    while (d == Vec3{}) d = cross(n, Vec3{whole(9), whole(9), whole(9)});
    const Point3 c{whole(1000), whole(1000), whole(1000)};
    const double k = 1 + static_cast<double>(random.index(1000));
    return {{c, w.length}, n, towards(c + n - k * d, d), k};
}

}  // namespace

TEST_CASE("Sphere: a tangent is a hit, a sphere one double smaller is missed, at every power of two",
          "[hard][sphere]") {
    Random random(513);
    Tally tally;
    for (int i = 0; i < count(1e6); ++i) {
        const Tangent tangent = whole_tangent(random);
        const int size = static_cast<int>(random.index(2050)) - 1074,
                  speed = static_cast<int>(random.index(2050)) - 1074;
        const Ball ball = scaled(tangent.ball, size);
        const Ray ray = scaled(tangent.ray, size, speed);
        const double times = std::ldexp(tangent.times, size - speed);
        const BothWorlds world(sphere_of(ball));
        const auto hit = world.hit(ray, tally);
        const bool in_reach = times > 0 && times <= std::numeric_limits<double>::max();
        if (in_reach && !(hit && hit->t == times)) tally.fault(ray, "tangent");
        for (const double radius :
             {ball.radius, std::nextafter(ball.radius, 0), std::nextafter(ball.radius, kInfinity)})
            if (radius > 0) judge_sphere(tally, BothWorlds(sphere_of({ball.center, radius})), ball.center, radius, ray);
    }
    check(tally, "tangents");
    CHECK((tally.hits > tally.rays / 5 && tally.hits < tally.rays * 9 / 10));
}

TEST_CASE("Sphere: rays 1e-7 to 1e-17 of the radius beside a tangent are decided exactly", "[hard][sphere]") {
    Random random(514);
    for (double offset = 1e-7; offset > 0.5e-17; offset /= 10) {
        Tally tally;
        for (int i = 0; i < count(1e3); ++i) {
            const Ball ball{Point3{} + random.in_cube(random.log_uniform(1e-3, 1e5)), random.log_uniform(1e-3, 1e3)};
            const BothWorlds world(sphere_of(ball), company_near(random, ball.center, ball.radius));
            for (int n = 0; n < 100; ++n) {
                const Vec3 outward = random.unit(), d = normalize(cross(outward, random.unit()));
                const Point3 contact = ball.center + ball.radius * (1 + random.uniform(-2, 2) * offset) * outward;
                judge_sphere(tally, world, ball.center, ball.radius,
                             towards(contact - ball.radius * random.log_uniform(0.1, 100) * d, d));
            }
        }
        check(tally, "offset " + number(offset));
        CHECK((tally.hits > tally.rays / 5 && tally.hits < tally.rays * 4 / 5));
    }
}

TEST_CASE("Sphere: from a point exactly on it rays inward hit the far side, and no ray hits where it starts",
          "[hard][sphere]") {
    Random random(515);
    Tally tally;
    for (int i = 0; i < count(1e5); ++i) {
        const Tangent tangent = whole_tangent(random);
        const Point3 start = tangent.ball.center + tangent.outward;
        const BothWorlds world(sphere_of(tangent.ball));
        for (const Vec3 d : {tangent.ray.direction, -tangent.outward, tangent.outward, random.unit()}) {
            for (const double t_min : {0.0, -0.0, -1.0, -5e-324}) {
                const Ray ray{start, d, t_min, kInfinity, 0};
                judge_sphere(tally, world, tangent.ball.center, tangent.ball.radius, ray);
            }
        }
        const auto across = world.hit(towards(start, -tangent.outward), tally);
        if (!across || across->t != 2) tally.fault(tangent.ray, "far side");
        if (world.hit(towards(start, tangent.outward), tally)) tally.fault(tangent.ray, "hit at its start");
        if (world.hit(towards(start, tangent.ray.direction), tally)) tally.fault(tangent.ray, "tangent at its start");
    }
    check(tally, "starts");
}

TEST_CASE("Sphere: the interval is open at t_min and closed at t_max, at the very roots and beside them",
          "[hard][sphere]") {
    Random random(516);
    Tally tally;
    for (int i = 0; i < count(1e5); ++i) {
        const Ball ball{Point3{} + random.in_cube(10), random.log_uniform(0.1, 10)};
        const BothWorlds world(sphere_of(ball), company_near(random, ball.center, ball.radius));
        const Point3 origin = ball.center + 3 * ball.radius * random.unit();
        const Vec3 d = ball.center + random.uniform(0, 0.999999) * ball.radius * random.unit() - origin;
        const auto within = [&](double t_min, double t_max) { return Ray{origin, d, t_min, t_max, 0}; };
        const auto t_of = [&](double t_min, double t_max) {
            judge_sphere(tally, world, ball.center, ball.radius, within(t_min, t_max));
            const auto hit = world.hit(within(t_min, t_max), tally);
            return hit ? hit->t : kInfinity;
        };
        const double near = t_of(0, kInfinity), far = t_of(near, kInfinity), between = near + (far - near) / 2;
        const bool right = near < far && far < kInfinity && t_of(0, near) == near && t_of(near, near) == kInfinity &&
                           t_of(between, kInfinity) == far && t_of(between, far) == far &&
                           t_of(far, kInfinity) == kInfinity && t_of(-kInfinity, kInfinity) == near;
        if (!right) tally.fault(within(0, kInfinity), "roots");
        for (const double root : {near, far})
            for (const double beside : {std::nextafter(root, 0), std::nextafter(root, kInfinity), root * (1 - 1e-12)})
                t_of(beside, kInfinity), t_of(0, beside);
    }
    check(tally, "ends");
}

TEST_CASE("Sphere: the interval's ends are decided exactly at roots that doubles hold", "[hard][sphere]") {
    const BothWorlds world(sphere_of({{0, 0, 10}, 2}));  // roots 8 and 12
    Tally tally;
    for (const double t_min : {0.0, std::nextafter(8, 0), 8.0, 9.0, std::nextafter(12, 0), 12.0, -kInfinity})
        for (const double t_max : {std::nextafter(8, 0), 8.0, 9.0, std::nextafter(12, 0), 12.0, kInfinity})
            judge_sphere(tally, world, {0, 0, 10}, 2, {{0, 0, 0}, {0, 0, 1}, t_min, t_max, 0}, 0);
    check(tally, "ends");
    CHECK(tally.hits == 21);
}

TEST_CASE("Sphere: coordinates and directions at the ends of double are decided exactly", "[hard][sphere]") {
    Random random(517);
    for (const int size : {-1074, -1060, -1030, -1000, -700, -530, -360, -200, 200, 360, 500, 530, 700, 1000, 1015}) {
        Tally tally;
        for (int i = 0; i < count(5e4); ++i) {
            const Ball plain{Point3{} + random.in_cube(6), random.log_uniform(0.2, 8)};
            const Ball ball = scaled(plain, size);
            if (ball.radius == 0) {
                ++tally.rays, ++tally.judged;
                continue;
            }
            const BothWorlds world(sphere_of(ball));
            const Point3 origin = Point3{} + random.in_cube(20);
            const Vec3 d = plain.center + 1.3 * plain.radius * random.unit() - origin;
            const int speed = static_cast<int>(random.index(2030)) - 1060;
            for (const int s : {0, size, speed}) {
                Ray ray = scaled(towards(origin, d), size, s);
                if (ray.direction == Vec3{}) ray.direction.x = 5e-324;
                judge_sphere(tally, world, ball.center, ball.radius, ray);
            }
        }
        check(tally, "2^" + std::to_string(size));
    }
}

TEST_CASE("Sphere: huge and tiny numbers in one question are decided exactly", "[hard][sphere]") {
    Random random(518);
    const auto wild = [&] {
        return random.sign() * std::ldexp(random.uniform(1, 2), static_cast<int>(random.index(1900)) - 950);
    };
    Tally tally;
    for (int i = 0; i < count(2e5); ++i) {
        const Ball ball{{wild(), wild(), wild()}, wild()};
        const Point3 on = ball.center + ball.radius * random.unit();
        const Point3 origin{wild(), wild(), wild()};
        const BothWorlds world(sphere_of(ball));
        for (const Vec3 d : {Vec3{wild(), wild(), wild()}, on - origin, ball.center - origin}) {
            if (!is_finite(d) || d == Vec3{}) continue;
            judge_sphere(tally, world, ball.center, ball.radius, towards(origin, d));
            judge_sphere(tally, world, ball.center, ball.radius, towards(on, d));
        }
    }
    check(tally, "wild");
    CHECK(tally.hits > tally.rays / 20);
}

TEST_CASE("Sphere: a negative radius is hit where the positive one is, and has the same box", "[hard][sphere]") {
    Random random(519);
    Tally tally;
    for (const double r : {1.0, 1e-45, 5e-324, 1e300, 0.1}) {
        const BothWorlds out(sphere_of({{0, 0, 0}, r})), in(sphere_of({{0, 0, 0}, -r}));
        CHECK(sphere_of({{0, 0, 0}, r})->bounds() == sphere_of({{0, 0, 0}, -r})->bounds());
        CHECK(is_finite(sphere_of({{0, 0, 0}, r})->bounds().lower));
        for (int i = 0; i < 200; ++i) {
            const Vec3 d = random.unit();
            const Ray ray{Point3{} + -2 * r * random.unit(), r < 1e-200 ? d : r * d, -kInfinity, kInfinity, 0};
            judge_sphere(tally, out, {0, 0, 0}, r, ray);
            judge_sphere(tally, in, {0, 0, 0}, r, ray);
        }
    }
    check(tally, "signs");
}

TEST_CASE("Sphere: whatever the length of the direction, t times it is the same", "[hard][sphere]") {
    const BothWorlds world(sphere_of({{0, 0, 10}, 1}));
    Tally tally;
    for (int k = -300; k <= 300; ++k) {
        const double s = std::pow(10.0, k);
        for (const Vec3 d : {Vec3{0, 0, s}, Vec3{0.1 * s, 0.01 * s, s}, Vec3{0.11 * s, 0, s}, Vec3{0, 0, -s}})
            judge_sphere(tally, world, {0, 0, 10}, 1, towards({0, 0, 0}, d));
        const auto hit = world.hit(towards({0, 0, 0}, {0, 0, s}), tally);
        CHECK((hit && std::abs(hit->t * s / 9 - 1) <= kUlp));
    }
    check(tally, "directions");
    CHECK(tally.hits == 2 * 601);
}

}  // namespace limn::sphere_limits_test
