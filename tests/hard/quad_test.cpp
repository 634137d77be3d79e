// Quads: thin, nearly folded, flat boxes far from the origin, and the boxes made of six.
#include "hard/hard.h"
#include "hard/shapes.h"
#include "limn/math/error.h"

namespace limn::quad_test {

using namespace test;

namespace {

struct Parallelogram {
    Point3 corner;
    Vec3 u, v;

    std::shared_ptr<const Quad> quad() const { return std::make_shared<Quad>(corner, u, v, nullptr); }
    Point3 at(double s, double t) const { return corner + s * u + t * v; }
};

void judge_quad(Tally& tally, const BothWorlds& world, const Parallelogram& s, const Ray& ray) {
    test::judge_quad(tally, world, s.corner, s.u, s.v, ray);
}

bool parallel(const Vec3& u, const Vec3& v) { return exactly_flat({}, Point3{} + u, Point3{} + v); }

Parallelogram scaled(const Parallelogram& s, int size) {
    return {test::scaled(s.corner, size), test::scaled(s.u, size), test::scaled(s.v, size)};
}

// Parameters of a point: on an edge, at a corner, or anywhere around.
std::pair<double, double> border(Random& random) {
    const double end = random.chance(0.5) ? 0 : 1, along = random.chance(0.3) ? end : random.uniform();
    return random.chance(0.5) ? std::pair(end, along) : std::pair(along, end);
}

}  // namespace

TEST_CASE("Quad: random rays, half of them degenerate, are decided exactly", "[hard][quad]") {
    Random random(560);
    const Parallelogram fixed[] = {{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}},
                                   {{213, 554, 227}, {130, 0, 0}, {0, 0, 105}},
                                   {{1e5, -1, 3}, {0, 2, 0}, {0, 0, 1}},
                                   {{2, 1, 0}, {1e4, 0, 3}, {0, 1, 1}}};
    Tally tally;
    for (int i = 0; i < count(4e3); ++i) {
        const double size = random.log_uniform(1e-12, 1e12);
        const Parallelogram s =
            i < 4 ? fixed[i]
                  : Parallelogram{Point3{} + random.in_cube(size), random.in_cube(size), random.in_cube(size)};
        const Targets targets{
            s.quad()->bounds(),
            {s.corner, s.at(1, 0), s.at(0, 1), s.at(1, 1), s.at(0.5, 0), s.at(1, 0.25), s.at(0.5, 0.5)}};
        const BothWorlds world(s.quad(), company_near(random, s.corner, length(s.u)));
        for (int n = 0; n < 1000; ++n) judge_quad(tally, world, s, random_ray(random, targets));
    }
    check(tally, "all");
    CHECK(tally.hits > tally.rays / 20);
}

TEST_CASE("Quad: whatever the length of the direction, t times it is the same", "[hard][quad]") {
    const Parallelogram s{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}};
    const BothWorlds world(s.quad());
    Tally tally;
    for (int k = -300; k <= 300; ++k) {
        const double length = std::pow(10.0, k);
        const auto hit = world.hit(towards({0, 0, 1}, {0, 0, -length}), tally);
        if (!hit || std::abs(hit->t * length - 1) > 0x1p-23) tally.fault({}, "length " + number(length));
        for (const Vec3 d : {Vec3{1, 1, -1}, Vec3{1, 0, -1}, Vec3{1, 0, -0.9999}, Vec3{1, 0, 1e-9}})
            judge_quad(tally, world, s, towards({0, 0, 1}, length * d));
    }
    check(tally, "lengths");
}

TEST_CASE("Quad: it is refused exactly where its edges are exactly parallel, zero, NaN or infinite", "[hard][quad]") {
    Random random(561);
    int refused = 0, differ = 0;
    for (int i = 0; i < count(1e5); ++i) {
        const auto wide = [&] {  // 40 bits: times 3, 5, 7 they still fit
            return random.sign() * static_cast<double>(random.index(std::size_t{1} << 40)) *
                   std::ldexp(1.0, static_cast<int>(random.index(1900)) - 1000);
        };
        Parallelogram s{{0, 0, 0}, wide() * Vec3{3, 5, 7}, wide() * Vec3{3, 5, 7}};
        if (i % 2) {
            double& one = (random.chance(0.5) ? s.u : s.v)[random.index(3)];
            one = std::nextafter(one, random.sign() * kInfinity);
        }
        bool throws = false;
        try {
            s.quad();
        } catch (const ArgumentError&) {
            throws = true;
        }
        refused += throws, differ += throws != parallel(s.u, s.v);
    }
    CHECK(differ == 0);
    CHECK((refused > count(1e5) / 3 && refused < count(1e5) * 2 / 3));
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity}) {
        CHECK_THROWS_AS(Quad({bad, 0, 0}, {1, 0, 0}, {0, 1, 0}, nullptr), ArgumentError);
        CHECK_THROWS_AS(Quad({0, 0, 0}, {1, bad, 0}, {0, 1, 0}, nullptr), ArgumentError);
        CHECK_THROWS_AS(Quad({0, 0, 0}, {1, 0, 0}, {0, 1, bad}, nullptr), ArgumentError);
    }
    CHECK_THROWS_AS(Quad({0, 0, 0}, {0, 0, 0}, {0, 1, 0}, nullptr), ArgumentError);
}

TEST_CASE("Quad: edges of 1e4 to 1 at a tenth of a degree, down to 1e-14 of a turn, are decided exactly",
          "[hard][quad]") {
    Random random(562);
    for (double angle = radians(0.1); angle > 1e-14; angle /= 10) {
        Tally tally;
        for (int i = 0; i < count(2e3); ++i) {
            const Vec3 along = random.unit(), across = normalize(cross(along, random.unit()));
            Parallelogram s{Point3{} + random.in_cube(3), 1e4 * along,
                            std::cos(angle) * along + std::sin(angle) * across};
            if (parallel(s.u, s.v)) s.v = across;
            const BothWorlds world(s.quad(), company_near(random, s.corner, 1));
            for (int n = 0; n < 100; ++n) {
                const auto [u, v] =
                    n % 2 ? border(random) : std::pair(random.uniform(-0.1, 1.1), random.uniform(-0.1, 1.1));
                const Vec3 d = random.unit();
                const Point3 aim = s.at(u, v) + random.log_uniform(1e-17, 1e-7) * random.unit();
                judge_quad(tally, world, s, towards(aim - random.uniform(1, 100) * d, d));
            }
        }
        check(tally, "angle " + number(angle));
    }
}

TEST_CASE("Quad: a flat box far from the origin is never missed", "[hard][quad]") {
    Random random(563);
    for (const double shift : {1e5, 1e7, 0.1}) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Parallelogram s{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
            s.corner[axis] = shift;
            s.u[(axis + 1) % 3] = 1, s.v[(axis + 2) % 3] = 1;
            const BothWorlds world(s.quad(), company_near(random, s.corner, 1));
            Tally tally;
            for (int i = 0; i < count(1e6 / 9); ++i) {
                const Point3 aim = s.at(random.uniform(0.001, 0.999), random.uniform(0.001, 0.999));
                Vec3 away = random.unit();
                if (i % 3 == 0) away[(axis + 1) % 3] = std::copysign(0.0, away.x);
                if (i % 3 == 1) away = {0, 0, 0}, away[axis] = random.sign();
                const Point3 eye = aim + random.log_uniform(1e-3, 1e3) * away;
                if (eye[axis] == aim[axis]) continue;
                const Ray ray = towards(eye, aim - eye);
                judge_quad(tally, world, s, ray);
                if (!world.hit(ray, tally)) tally.fault(ray, "missed");
            }
            check(tally, "at " + number(shift));
        }
    }
}

TEST_CASE("Quad: rays exactly through corners and edges hit, one double beside them they are decided exactly",
          "[hard][quad]") {
    Random random(564);
    const auto whole = [&](int limit) {
        const auto x = [&] {
            return static_cast<double>(random.index(2 * static_cast<std::size_t>(limit) + 1)) - limit;
        };
        return Vec3{x(), x(), x()};
    };
    Tally tally;
    for (int i = 0; i < count(2e5); ++i) {
        const double m = 1 + static_cast<double>(random.index(30)), t = 1 + static_cast<double>(random.index(99));
        const Parallelogram plain{Point3{} + whole(100), m * whole(9), m * whole(9)};
        const Vec3 d = whole(50);
        ++tally.rays, ++tally.judged;
        if (dot(cross(plain.u, plain.v), d) == 0) continue;
        const int size = static_cast<int>(random.index(1900)) - 1000,
                  speed = static_cast<int>(random.index(1900)) - 1000;
        const Parallelogram s = scaled(plain, size);
        const BothWorlds world(s.quad());
        const double j = static_cast<double>(random.index(static_cast<std::size_t>(m) + 1)) / m;
        const auto edge = [&](double a, double b) {  // whole again
            const Point3 p = plain.at(a, b);
            return Point3{std::round(p.x), std::round(p.y), std::round(p.z)};
        };
        for (const Point3 on : {edge(0, j), edge(1, j), edge(j, 0), edge(j, 1)}) {
            const Ray ray = test::scaled(towards(on - t * d, d), size, speed);
            const auto hit = world.hit(ray, tally);
            const double times = std::ldexp(t, size - speed);
            if (times > 1e-300 && times < 1e300 && !(hit && hit->t == times)) tally.fault(ray, "not closed");
            judge_quad(tally, world, s, ray);
            Ray beside = ray;
            const std::size_t axis = random.index(3);
            beside.direction[axis] = std::nextafter(ray.direction[axis], random.sign() * kInfinity);
            judge_quad(tally, world, s, beside);
            beside = ray;
            beside.origin[axis] = std::nextafter(ray.origin[axis], random.sign() * kInfinity);
            judge_quad(tally, world, s, beside);
        }
    }
    check(tally, "whole numbers");
    CHECK(tally.hits > tally.rays / 5);
}

TEST_CASE("Quad: rays 1e-7 to 1e-17 beside its border, and ends of the interval at its t, are decided exactly",
          "[hard][quad]") {
    Random random(565);
    for (double offset = 1e-7; offset > 0.5e-17; offset /= 10) {
        Tally tally;
        for (int i = 0; i < count(1e3); ++i) {
            const Parallelogram s{Point3{} + random.in_cube(5), random.in_cube(2), random.in_cube(2)};
            const BothWorlds world(s.quad(), company_near(random, s.corner, 1));
            for (int n = 0; n < 100; ++n) {
                const auto [u, v] = border(random);
                const Vec3 d = random.log_uniform(0.1, 10) * random.unit();
                Ray ray = towards(s.at(u, v) + offset * random.in_cube() - random.uniform(0.5, 5) * d, d);
                judge_quad(tally, world, s, ray);
                const auto hit = world.hit(ray, tally);
                if (!hit) continue;
                const double t = hit->t;
                for (const double end : {t, std::nextafter(t, 0), std::nextafter(t, kInfinity), t * (1 + 1e-11)}) {
                    ray.t_min = 0, ray.t_max = end;
                    judge_quad(tally, world, s, ray);
                    ray.t_min = end, ray.t_max = kInfinity;
                    judge_quad(tally, world, s, ray);
                }
            }
        }
        check(tally, "offset " + number(offset));
    }
}

TEST_CASE("Quad: coordinates and directions at the ends of double are decided exactly", "[hard][quad]") {
    Random random(566);
    for (const int size :
         {-1074, -1060, -1030, -1000, -700, -530, -360, -200, 200, 360, 500, 508, 510, 530, 700, 1000, 1015}) {
        Tally tally;
        for (int i = 0; i < count(3e4); ++i) {
            const Parallelogram plain{Point3{} + random.in_cube(20), random.in_cube(20), random.in_cube(20)};
            const Parallelogram s = scaled(plain, size);
            ++tally.rays, ++tally.judged;
            if (parallel(s.u, s.v)) continue;
            const BothWorlds world(s.quad());
            const Point3 origin = Point3{} + random.in_cube(60);
            const Vec3 d = plain.at(random.uniform(-0.1, 1.1), random.uniform(-0.1, 1.1)) - origin;
            for (const int speed : {0, size, static_cast<int>(random.index(2030)) - 1060}) {
                Ray ray = test::scaled(towards(origin, d), size, speed);
                if (ray.direction == Vec3{}) ray.direction.x = 5e-324;
                judge_quad(tally, world, s, ray);
            }
        }
        check(tally, "2^" + std::to_string(size));
    }
    Tally tally;
    const auto wild = [&] {
        return random.sign() * std::ldexp(random.uniform(1, 2), static_cast<int>(random.index(1900)) - 950);
    };
    for (int i = 0; i < count(2e5); ++i) {
        const Parallelogram s{{wild(), wild(), wild()}, {wild(), wild(), wild()}, {wild(), wild(), wild()}};
        const Point3 origin{wild(), wild(), wild()};
        const BothWorlds world(s.quad());
        for (const Vec3 d : {Vec3{wild(), wild(), wild()}, s.at(0.3, 0.6) - origin, s.at(1, 0.5) - origin})
            judge_quad(tally, world, s, towards(origin, d));
    }
    check(tally, "wild");
    CHECK(tally.hits > tally.rays / 20);
}

TEST_CASE("make_box: no ray from inside escapes through edges and corners, placed, turned or nested as it may be",
          "[hard][quad]") {
    Random random(567);
    const auto turned = [&] {
        return Transform::translate(random.in_cube(1e3)) * Transform::rotate(random.unit(), random.uniform(0, 360)) *
               Transform::scale(random.log_uniform(0.01, 100), 1, random.sign() * 3);
    };
    for (int kind = 0; kind < 4; ++kind) {
        Tally tally;
        for (int i = 0; i < count(3e3); ++i) {
            const double place = random.log_uniform(1e-3, 1e6);
            Point3 lower = Point3{} + random.in_cube(place), upper = lower + Vec3{1, 1, 1} + random.in_cube(0.9);
            if (kind == 0) lower = {-1, -2, -3}, upper = {3, 2, 1};
            const Point3 corners[] = {lower, upper};
            Object box = make_box(lower, upper, nullptr);
            Transform m;
            if (kind >= 2) {
                m = turned();
                box = std::make_shared<Instance>(box, m);
            }
            if (kind == 3) {
                const Transform outer = turned();
                box = std::make_shared<Instance>(box, outer);
                m = outer * m;  // aims only: its rounding moves a ray by no more than 1e-12
            }
            const BothWorlds world(box);
            for (int n = 0; n < 100; ++n) {
                const double s = random.uniform(0.2, 0.8);
                const Point3 origin = transform_point(m, lower + s * (upper - lower));
                Point3 aim;
                for (std::size_t a = 0; a < 3; ++a) aim[a] = corners[random.index(2)][a];
                if (n % 2) {
                    const std::size_t axis = random.index(3);
                    aim[axis] = random.uniform(lower[axis], upper[axis]);
                }
                aim = transform_point(m, aim);
                const Ray ray = towards(origin, aim - origin);
                ++tally.rays, ++tally.judged;
                const auto hit = world.hit(ray, tally);
                if (!hit)
                    tally.fault(ray, "escaped");
                else if (std::abs(hit->t - 1) > 1e-2)
                    tally.fault(ray, "elsewhere");
            }
        }
        check(tally, "kind " + std::to_string(kind));
    }
}

}  // namespace limn::quad_test
