// Triangles in double: slivers, grazing rays, rays aimed at edges and vertices, of every size.
#include "hard/hard.h"
#include "hard/shapes.h"
#include "limn/math/error.h"

namespace limn::triangle_test {

using namespace test;

namespace {

using Corners = std::array<Point3, 3>;

std::shared_ptr<const Triangle> triangle_of(const Corners& k) {
    return std::make_shared<Triangle>(k[0], k[1], k[2], nullptr);
}

Point3 at(const Corners& k, double u, double v) { return k[0] + u * (k[1] - k[0]) + v * (k[2] - k[0]); }

// A point of an edge, up to rounding, and the direction in the plane that leads out across it.
struct EdgePoint {
    Point3 p;
    Vec3 out;
};
EdgePoint edge_point(Random& random, const Corners& k) {
    const std::size_t i = random.index(3);
    const Point3 a = k[i], b = k[(i + 1) % 3];
    const Vec3 n = cross(k[1] - k[0], k[2] - k[0]);
    return {a + random.uniform() * (b - a), normalize(cross(b - a, n))};
}

Corners random_corners(Random& random, double size) {
    const Point3 p = Point3{} + random.in_cube(3 * size);
    return {p, p + random.in_cube(size), p + random.in_cube(size)};
}

// A sliver of length 1: its height is 1 / aspect.
Corners sliver(Random& random, double aspect) {
    const Vec3 along = random.unit(), across = normalize(cross(along, random.unit()));
    const Point3 a = Point3{} + random.in_cube(5);
    return {a, a + along, a + random.uniform() * along + (1 / aspect) * across};
}

Corners to_float(const Corners& k) { return {test::to_float(k[0]), test::to_float(k[1]), test::to_float(k[2])}; }

}  // namespace

TEST_CASE("Triangle: random rays, half of them degenerate, are decided exactly", "[hard][triangle]") {
    Random random(530);
    const Corners fixed[] = {{Point3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                             {Point3{1e5, 1e5, 1e5}, {1e5 + 1, 1e5, 1e5}, {1e5, 1e5 + 1, 1e5 - 1}},
                             {Point3{-5, 0, 2}, {4, 1e-3, 2}, {3, 2, -7}},
                             {Point3{0, 0, 0}, {1, 0, 0}, {0.5, 1e-4, 0}}};
    Tally tally;
    for (int i = 0; i < count(4e3); ++i) {
        const Corners k = i < 4 ? fixed[i] : random_corners(random, random.log_uniform(1e-12, 1e12));
        const Targets targets{triangle_of(k)->bounds(),
                              {k[0], k[1], k[2], at(k, 0.5, 0), at(k, 0.75, 0.25), at(k, 0, 0.125), at(k, 0.3, 0.3)}};
        const BothWorlds world(triangle_of(k), company_near(random, k[0], length(k[1] - k[0])));
        for (int n = 0; n < 1000; ++n) judge_triangle(tally, world, k, random_ray(random, targets));
    }
    check(tally, "all");
    CHECK(tally.hits > tally.rays / 20);
}

TEST_CASE("Triangle: slivers of aspect 1e2 to 1e12 are decided exactly", "[hard][triangle]") {
    Random random(531);
    for (double aspect = 1e2; aspect < 2e12; aspect *= 10) {
        Tally tally;
        for (int i = 0; i < count(1e4); ++i) {
            const bool in_float = i % 2 == 0 && aspect < 2e7;
            Corners k = sliver(random, aspect);
            if (in_float) k = to_float(k);
            if (exactly_flat(k[0], k[1], k[2])) k = sliver(random, aspect);
            const BothWorlds world(triangle_of(k), company_near(random, k[0], 0.3));
            for (int n = 0; n < 100; ++n) {
                const Point3 aim = at(k, random.uniform(-0.2, 1.2), random.uniform(-0.2, 1.2));
                const Point3 eye = aim + random.uniform(1, 10) * random.unit();
                judge_triangle(
                    tally, world, k,
                    in_float ? towards(test::to_float(eye), test::to_float(aim - eye)) : towards(eye, aim - eye));
            }
        }
        check(tally, "aspect " + number(aspect));
        CHECK(tally.hits > tally.rays / 1000);
    }
}

TEST_CASE("Triangle: rays within 1e-7 to 1e-17 of the edges of slivers are decided exactly", "[hard][triangle]") {
    Random random(532);
    for (const double aspect : {1.0, 1e3, 1e6, 1e9})
        for (double offset = 1e-7; offset > 0.5e-17; offset /= 10) {
            Tally tally;
            for (int i = 0; i < count(1e3); ++i) {
                const Corners k = sliver(random, aspect);
                const BothWorlds world(triangle_of(k));
                for (int n = 0; n < 100; ++n) {
                    const EdgePoint e = edge_point(random, k);
                    const Point3 aim = e.p + random.uniform(-1, 1) * offset * e.out;
                    const Vec3 d = random.log_uniform(0.1, 10) * random.unit();
                    judge_triangle(tally, world, k, towards(aim - random.uniform(0.5, 5) * d, d));
                }
            }
            check(tally, "aspect " + number(aspect) + ", offset " + number(offset));
            if (offset * aspect < 1) CHECK((tally.hits > tally.rays / 10 && tally.hits < tally.rays * 9 / 10));
        }
}

TEST_CASE("Triangle: grazing rays, down to 1e-13 radians, are decided exactly", "[hard][triangle]") {
    Random random(533);
    const Corners k{Point3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
        turned{Point3{0.1, 0.2, 0.3}, {1.1, 0.7, 0.4}, {0.3, 1.3, 0.9}};
    const BothWorlds flat(triangle_of(k)), tilted(triangle_of(turned));
    const Vec3 x = normalize(turned[1] - turned[0]), z = normalize(cross(x, turned[2] - turned[0])), y = cross(z, x);
    for (double angle = 1e-1; angle > 0.5e-13; angle /= 10) {
        Tally tally;
        for (int i = 0; i < count(1e5); ++i) {
            const double around = random.uniform(0, 2 * kPi), u = random.uniform(-0.1, 1), v = random.uniform(-0.1, 1);
            const Vec3 d{std::cos(around) * std::cos(angle), std::sin(around) * std::cos(angle), -std::sin(angle)};
            judge_triangle(tally, flat, k, towards(at(k, u, v) - 10 * d, d));
            const Vec3 e = d.x * x + d.y * y + d.z * z;
            judge_triangle(tally, tilted, turned, towards(at(turned, u, v) - 10 * e, e));
        }
        check(tally, "angle " + number(angle));
    }
}

TEST_CASE("Triangle: size does not matter, no triangle is too small or too large", "[hard][triangle]") {
    Tally tally;
    for (int k = -300; k <= 300; ++k) {
        const double s = std::pow(10.0, k);
        const Corners corners{Point3{0, 0, 0}, {s, 0, 0}, {0, s, 0}};
        const BothWorlds world(triangle_of(corners));
        const auto hit = world.hit(towards({s / 3, s / 3, -10 * s}, {0, 0, 1}), tally);
        if (!(hit && std::abs(hit->t / (10 * s) - 1) <= 0x1p-23 && std::abs(hit->u - 1.0 / 3) <= 0x1p-23))
            tally.fault({}, "size " + number(s));
        for (const double x : {s / 3, -s / 1e15, -s / 1e300, s / 1e15, s / 1e300, 0.0, s, std::nextafter(s, kInfinity)})
            judge_triangle(tally, world, corners, towards({x, 0, -10 * s}, {0, 0, s}));
        judge_triangle(tally, world, corners, towards({s / 3, s / 3, -1}, {0, 0, 1}));
    }
    check(tally, "sizes");
    const double s = 2e-4;
    CHECK(BothWorlds(triangle_of({Point3{0, 0, 0}, {s, 0, 0}, {0, s, 0}}))
              .hit(towards({s / 3, s / 3, -1}, {0, 0, 1}), tally)
              ->t == 1);
}

TEST_CASE("Triangle: rays exactly through vertices and edges hit, one double beside them they are decided exactly",
          "[hard][triangle]") {
    Random random(534);
    const auto whole = [&](int limit) {
        const auto x = [&] {
            return static_cast<double>(random.index(2 * static_cast<std::size_t>(limit) + 1)) - limit;
        };
        return Vec3{x(), x(), x()};
    };
    Tally tally;
    for (int i = 0; i < count(2e5); ++i) {
        const Vec3 e = whole(9), f = whole(9), d = whole(50);
        const Point3 a = Point3{} + whole(100);
        const double m = 1 + static_cast<double>(random.index(30)), t = 1 + static_cast<double>(random.index(99));
        const Corners k{a, a + m * e, a + m * f};
        if (exactly_flat(k[0], k[1], k[2]) || dot(cross(e, f), d) == 0) {
            ++tally.rays, ++tally.judged;
            continue;
        }
        const int size = static_cast<int>(random.index(1900)) - 1000,
                  speed = static_cast<int>(random.index(1900)) - 1000;
        const Corners small{scaled(k[0], size), scaled(k[1], size), scaled(k[2], size)};
        const BothWorlds world(triangle_of(small));
        const double j = static_cast<double>(random.index(static_cast<std::size_t>(m) + 1));
        for (const Point3 on : {a + j * e, a + j * f, a + j * e + (m - j) * f}) {
            const Ray ray = scaled(towards(on - t * d, d), size, speed);
            const auto hit = world.hit(ray, tally);
            const double times = std::ldexp(t, size - speed);
            if (times > 1e-300 && times < 1e300 && !(hit && hit->t == times)) tally.fault(ray, "not closed");
            judge_triangle(tally, world, small, ray);
            Ray beside = ray;
            const std::size_t axis = random.index(3);
            beside.direction[axis] = std::nextafter(ray.direction[axis], random.sign() * kInfinity);
            judge_triangle(tally, world, small, beside);
            beside = ray;
            beside.origin[axis] = std::nextafter(ray.origin[axis], random.sign() * kInfinity);
            judge_triangle(tally, world, small, beside);
        }
    }
    check(tally, "whole numbers");
    CHECK(tally.hits > tally.rays / 5);
}

TEST_CASE("Triangle: a ray in its plane misses, from within, along an edge, and through a vertex", "[hard][triangle]") {
    Random random(535);
    Tally tally;
    for (int i = 0; i < count(1e5); ++i) {
        const auto small = [&] { return static_cast<double>(random.index(41)) - 20; };
        const Vec3 e{small(), small(), small()}, f{small(), small(), small()};
        const Point3 a{small(), small(), small()};
        const Corners k{a, a + e, a + f};
        if (exactly_flat(k[0], k[1], k[2])) continue;
        const BothWorlds world(triangle_of(k));
        for (const Vec3 d : {e, f, e - f, e + f, 3 * e - 2 * f, -e}) {
            for (const Point3 o : {a, a - e, a - 2 * f, a + e, a + 5 * f - 7 * e}) {
                judge_triangle(tally, world, k, towards(o, d));
                if (world.hit(towards(o, d), tally)) tally.fault(towards(o, d), "hit in the plane");
            }
        }
    }
    check(tally, "planes");
    CHECK(tally.hits == 0);
}

TEST_CASE("Triangle: from a point on it, on its edge or at a vertex, no ray hits where it starts", "[hard][triangle]") {
    Random random(536);
    const Corners k{Point3{0, 0, 0}, {8, 0, 4}, {0, 8, 4}};  // z = (x + y) / 2
    const BothWorlds world(triangle_of(k));
    Tally tally;
    for (int i = 0; i < count(2e5); ++i) {
        const auto x = static_cast<double>(random.index(9)),
                   y = static_cast<double>(random.index(9 - static_cast<std::size_t>(x)));
        for (const double t_min : {0.0, -0.0, -1.0, -5e-324, 5e-324}) {
            const Ray ray{{x, y, (x + y) / 2}, random.unit(), t_min, kInfinity, 0};
            judge_triangle(tally, world, k, ray);
            if (world.hit(ray, tally).has_value() != (t_min < 0)) tally.fault(ray, "start");
        }
    }
    check(tally, "starts");
}

TEST_CASE("Triangle: the interval is open at t_min and closed at t_max, at the very t and beside it",
          "[hard][triangle]") {
    Random random(537);
    Tally tally;
    for (int i = 0; i < count(1e5); ++i) {
        const Corners k = random_corners(random, random.log_uniform(1e-3, 1e3));
        const BothWorlds world(triangle_of(k));
        const Point3 eye = k[0] + 5 * length(k[1] - k[0]) * random.unit();
        const Ray ray = towards(eye, at(k, 0.3, 0.4) - eye);
        const auto hits = [&](double t_min, double t_max) {
            const Ray within{ray.origin, ray.direction, t_min, t_max, 0};
            judge_triangle(tally, world, k, within);
            return world.hit(within, tally).has_value();
        };
        const auto hit = world.hit(ray, tally);
        if (!hit) {
            tally.fault(ray, "missed");
            continue;
        }
        const double t = hit->t;
        if (!hits(0, t) || hits(t, kInfinity) || hits(t, t) || !hits(-kInfinity, t)) tally.fault(ray, "ends");
        for (const double beside :
             {std::nextafter(t, 0), std::nextafter(t, kInfinity), t * (1 - 1e-12), t * (1 + 1e-9)})
            hits(beside, kInfinity), hits(0, beside);
    }
    check(tally, "ends");
}

TEST_CASE("Triangle: coordinates and directions at the ends of double are decided exactly", "[hard][triangle]") {
    Random random(538);
    for (const int size : {-1074, -1060, -1030, -1000, -700, -530, -360, -200, 200, 360, 500, 530, 700, 1000, 1015}) {
        Tally tally;
        for (int i = 0; i < count(5e4); ++i) {
            const Corners plain = random_corners(random, 20);
            const Corners k{scaled(plain[0], size), scaled(plain[1], size), scaled(plain[2], size)};
            ++tally.rays, ++tally.judged;
            if (exactly_flat(k[0], k[1], k[2])) continue;
            const BothWorlds world(triangle_of(k));
            const Point3 origin = Point3{} + random.in_cube(60);
            const Vec3 d = at(plain, random.uniform(-0.1, 0.8), random.uniform(-0.1, 0.8)) - origin;
            for (const int speed : {0, size, static_cast<int>(random.index(2030)) - 1060}) {
                Ray ray = scaled(towards(origin, d), size, speed);
                if (ray.direction == Vec3{}) ray.direction.x = 5e-324;
                judge_triangle(tally, world, k, ray);
            }
        }
        check(tally, "2^" + std::to_string(size));
    }
}

TEST_CASE("Triangle: huge and tiny numbers in one question are decided exactly", "[hard][triangle]") {
    Random random(539);
    const auto wild = [&] {
        return random.sign() * std::ldexp(random.uniform(1, 2), static_cast<int>(random.index(1900)) - 950);
    };
    const auto wild_point = [&] { return Point3{wild(), wild(), wild()}; };
    Tally tally;
    for (int i = 0; i < count(1e5); ++i) {
        const Corners k{wild_point(), wild_point(), wild_point()};
        const Point3 origin = wild_point();
        const BothWorlds world(triangle_of(k));
        for (const Vec3 d : {wild_point() - Point3{}, at(k, 0.3, 0.3) - origin, at(k, 0.5, 0) - origin, k[2] - origin})
            judge_triangle(tally, world, k, towards(origin, d));
    }
    check(tally, "wild");
    CHECK(tally.hits > tally.rays / 20);
}

TEST_CASE("Triangle: skinny ones seen half a degree off their plane report a t between their vertices'",
          "[hard][triangle]") {
    Random random(540);
    Tally tally;
    for (int i = 0; i < count(1e6); ++i) {
        const Vec3 along = random.unit(), across = normalize(cross(along, random.unit())), n = cross(along, across);
        const Point3 a = Point3{} + random.in_cube(300);
        Corners k{a, a + 11.2 * along, a + 9.7 * along + random.log_uniform(1e-3, 0.5) * across};
        if (i % 2) k = to_float(k);
        const double turn = random.uniform(0, 2 * kPi), slope = radians(0.52);
        const Vec3 d = std::cos(slope) * (std::cos(turn) * along + std::sin(turn) * across) + std::sin(slope) * n;
        const Ray ray = towards(at(k, random.uniform(), random.uniform()) - random.uniform(1, 600) * d, d);
        const BothWorlds world(triangle_of(k));
        judge_triangle(tally, world, k, ray);
        const auto hit = world.hit(ray, tally);
        if (!hit) continue;
        double low = kInfinity, high = -kInfinity;
        for (const Point3& p : k)
            low = std::min(low, dot(p - ray.origin, d)), high = std::max(high, dot(p - ray.origin, d));
        if (hit->t < low * (1 - 0x1p-21) || hit->t > high * (1 + 0x1p-21)) tally.fault(ray, "t outside the vertices'");
    }
    check(tally, "skinny");
}

TEST_CASE("Triangle: it is refused exactly where its area is exactly zero", "[hard][triangle]") {
    Random random(541);
    int flat = 0, refused = 0, differ = 0;
    for (int i = 0; i < count(1e5); ++i) {
        const Vec3 d{3, 5, 7};
        const auto far = [&] {
            return static_cast<double>(random.index(1 << 21)) * std::ldexp(1.0, static_cast<int>(random.index(64)));
        };
        Corners k{Point3{} + far() * d, Point3{} + far() * d,
                  Point3{} + far() * d};  // on a line, coordinates of 24 bits
        if (i % 2) {
            double& one = k[random.index(3)][random.index(3)];
            one = std::nextafter(one, random.sign() * kInfinity);
        }
        if (i % 8 == 7) k = {Point3{0, 0, 0}, {0.1, 0.3, 0}, {0.1 * 3, 0.3 * 3, 0}};
        const bool is_flat = exactly_flat(k[0], k[1], k[2]);
        bool throws = false;
        try {
            triangle_of(k);
        } catch (const ArgumentError&) {
            throws = true;
        }
        flat += is_flat, refused += throws, differ += is_flat != throws;
    }
    CHECK(differ == 0);
    CHECK(flat == refused);
    CHECK((flat > count(1e5) / 3 && flat < count(1e5) * 2 / 3));
    // pbrt's bad case: vertices that share x and z are collinear whatever their y.
    CHECK_THROWS_AS(triangle_of({Point3{-1113.45459, -79.049614, -56.2431908},
                                 {-1113.45459, -87.0922699, -56.2431908},
                                 {-1113.45459, -79.2090149, -56.2431908}}),
                    ArgumentError);
}

}  // namespace limn::triangle_test
