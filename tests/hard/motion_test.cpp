// Moving spheres and moving instances: exact at both ends, at any time the exact shape there, and boxed over the whole
// shutter.
#include "catch.h"
#include "hard/placed.h"

namespace limn::motion_test {

using namespace test;

namespace {

double any_double(Random& random) {
    switch (random.index(4)) {
        case 0: return random.uniform(-10, 10);
        case 1: return random.sign() * random.log_uniform(1e-300, 1e300);
        case 2: return random.sign() * 5e-324 * static_cast<double>(random.index(1000));
        default: return random.sign() * static_cast<double>(random.index(5));
    }
}
Point3 any_point(Random& random) {
    const double x = any_double(random), y = any_double(random);
    return {x, y, any_double(random)};
}

// Times within the shutter, at its ends and next to them.
double any_time(Random& random) {
    const double special[] = {0, -0.0, 1, 5e-324, 0x1p-53, 1 - 0x1p-53, 0.5, 1 + 0x1p-52, -0x1p-60, -3, 7};
    return random.chance(0.3) ? special[random.index(std::size(special))] : random.uniform();
}

Transform any_matrix(Random& random) {
    Transform m;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) m.rows[i][j] = random.uniform(-0.4, 0.4);
        m.rows[i][i] = random.uniform(1, 2);
        m.rows[i][3] = random.uniform(-3, 3);
    }
    return m;
}

// Tangents and all else at a sphere.
Ray ray_at(Random& random, const Point3& center, double radius) {
    const Vec3 away = random.unit(), aside = normalize(cross(away, random.unit()));
    const double distance = random.log_uniform(1.001, 1e4);
    const double tangent = distance / std::sqrt(distance * distance - 1);
    const double reach =
        random.chance(0.5) ? tangent * (1 + random.sign() * random.log_uniform(1e-17, 1e-3)) : random.uniform(0, 1.5);
    Ray ray;
    ray.origin = center + distance * radius * away;
    ray.direction = random.log_uniform(1e-3, 1e3) * (center + reach * radius * aside - ray.origin);
    return ray;
}

}  // namespace

TEST_CASE(
    "Motion: at time 0 and 1 a sphere's centre and an instance's matrix are as given, to the bit, and outside the "
    "shutter they stay there",
    "[hard][motion]") {
    Random random(4700);
    int wrong = 0;
    for (int i = 0; i < count(1e6); ++i) {
        const Point3 from = any_point(random), to = any_point(random);
        const Sphere sphere(from, to, 1, nullptr);
        for (const double time : {0.0, -0.0, -5e-324, -1.0, -1e300}) wrong += !(sphere.center(time) == from);
        for (const double time : {1.0, 1 + 0x1p-52, 2.0, 1e300}) wrong += !(sphere.center(time) == to);
        const Transform a = any_matrix(random), b = any_matrix(random);
        wrong += !(interpolate(a, b, 0) == a) + !(interpolate(a, b, -2) == a);
        wrong += !(interpolate(a, b, 1) == b) + !(interpolate(a, b, 1.5) == b);
    }
    CHECK(wrong == 0);
}

TEST_CASE("Motion: the centre stays between its ends, and is finite for the largest numbers", "[hard][motion]") {
    Random random(4710);
    int wrong = 0;
    for (int i = 0; i < count(1e6); ++i) {
        const Point3 from = any_point(random), to = any_point(random);
        const Point3 c = Sphere(from, to, 1, nullptr).center(any_time(random));
        for (std::size_t a = 0; a < 3; ++a) {
            // But for the rounding of two products and a sum, subnormal ones included.
            const double slack = 4 * 0x1p-53 * std::max(std::abs(from[a]), std::abs(to[a])) + 2 * 5e-324;
            wrong += !(c[a] >= std::min(from[a], to[a]) - slack && c[a] <= std::max(from[a], to[a]) + slack);
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("Motion: what opens where it closes is hit as what stands still, to the bit", "[hard][motion]") {
    Random random(4720);
    Tally tally;
    for (int set = 0; set < 20; ++set) {
        const Point3 c = Point3{} + random.in_cube(100);
        const Transform m = any_matrix(random);
        const Object triangle = std::make_shared<Triangle>(c, c + random.in_cube(), c + random.in_cube(), nullptr);
        const std::pair<Object, Object> pairs[] = {
            {ball(c, 1.5), std::make_shared<Sphere>(c, c, 1.5, nullptr)},
            {std::make_shared<Instance>(triangle, m), std::make_shared<Instance>(triangle, m, m)}};
        for (const auto& [still, moving] : pairs) {
            const BothWorlds a(still), b(moving);
            const Point3 middle = still->bounds().center();
            for (int i = 0; i < count(1e6) / 40; ++i) {
                Ray ray = ray_at(random, middle, 1.5);
                ray.time = any_time(random);
                const auto expected = a.hit(ray, tally), found = b.hit(ray, tally);
                ++tally.rays, ++tally.judged;
                if (expected.has_value() != found.has_value()) tally.fault(ray, "hit");
                if (expected && found && (expected->t != found->t || expected->u != found->u)) tally.fault(ray, "t, u");
                tally.hits += expected.has_value();
            }
        }
    }
    check(tally, "still");
    CHECK(tally.hits > tally.rays / 10);
}

TEST_CASE("Motion: at any time a moving sphere is hit as a still one at its centre then, in exact arithmetic",
          "[hard][motion]") {
    for (const double radius : {1e-3, 1.0, 1e3})
        for (const double place : {0.0, 1e3, 1e5}) {
            Random random(4730);
            Tally tally;
            for (int set = 0; set < 10; ++set) {
                const Point3 from = Point3{} + place * random.unit(), to = from + random.in_cube(3 * radius);
                const Sphere sphere(from, to, radius, nullptr);
                const BothWorlds worlds(std::make_shared<Sphere>(sphere), {ball({0, 0, -7000}, 2)});
                for (int i = 0; i < count(1e5) / 10; ++i) {
                    const double time = any_time(random);
                    const Point3 center = sphere.center(time);
                    Ray ray = ray_at(random, center, radius);
                    ray.time = time;
                    judge(
                        tally, ray, [&](const Ray& r) { return exact_sphere_hit(center, radius, r); },
                        [&](const Ray& r) { return worlds.hit(r, tally); }, {.t_ulps = 1, .uv = -1});
                }
            }
            check(tally, "radius " + std::to_string(radius) + " at " + std::to_string(place));
            CHECK(tally.hits > tally.rays / 4);
        }
}

TEST_CASE("Motion: at any time a moving instance is hit as a still one under its matrix then, in exact arithmetic",
          "[hard][motion]") {
    for (const Placed::Kind kind :
         {Placed::Kind::sphere, Placed::Kind::triangle, Placed::Kind::quad, Placed::Kind::mesh}) {
        Random random(4740);
        Tally tally;
        for (int set = 0; set < count(1e4); ++set) {
            Placed placed;
            placed.kind = kind;
            placed.p = Point3{} + random.in_cube(), placed.e = random.in_cube(), placed.f = random.in_cube();
            if (kind == Placed::Kind::mesh) placed.mesh = cube_mesh();
            // One or two moving ones, one in the other, and perhaps a still one between.
            std::vector<std::pair<Transform, Transform>> moves;
            for (std::size_t i = 0; i <= random.index(3); ++i) {
                const Transform a = any_matrix(random);
                moves.emplace_back(a, i == 1 ? a : any_matrix(random));
            }
            Object object = placed.shape();
            for (std::size_t i = moves.size(); i-- > 0;)
                object = std::make_shared<Instance>(object, moves[i].first, moves[i].second);
            const BothWorlds worlds(object, {ball({0, 0, -7000}, 2)});
            for (int i = 0; i < 20; ++i) {
                const double time = any_time(random);
                placed.chain.clear();
                for (const auto& [a, b] : moves) placed.chain.push_back(a == b ? a : interpolate(a, b, time));
                Ray ray = aimed_ray(random, placed, placed.awkward_points(), 3);
                ray.time = time;
                judge(tally, placed, worlds, ray);
            }
        }
        check(tally, "kind " + std::to_string(static_cast<int>(kind)));
        CHECK(tally.hits > tally.rays / 10);
    }
}

TEST_CASE("Motion: the box of a moving sphere contains it, exactly, at 1e3 times of each of 1e4 motions",
          "[hard][motion]") {
    Random random(4800);
    int outside = 0;
    for (int i = 0; i < count(1e4); ++i) {
        const double size = random.log_uniform(1e-6, 1e6);
        const Point3 from = Point3{} + random.in_cube(random.log_uniform(1e-6, 1e6));
        const Point3 to = random.chance(0.2) ? from + Vec3{0, size, 0} : from + random.in_cube(size);
        const double radius = random.sign() * random.log_uniform(1e-6, 1e6);
        const Sphere sphere(from, to, radius, nullptr);
        const Box box = sphere.bounds();
        for (int k = 0; k < 1000; ++k) {
            const Point3 c = sphere.center(any_time(random));
            for (std::size_t a = 0; a < 3; ++a)
                outside += Real(c[a]) - absolute(Real(radius)) < Real(box.lower[a]) ||
                           Real(c[a]) + absolute(Real(radius)) > Real(box.upper[a]);
        }
    }
    CHECK(outside == 0);
}

TEST_CASE("Motion: the box of a moving instance contains the exact image of its object at any time", "[hard][motion]") {
    Random random(4810);
    int outside = 0;
    for (int i = 0; i < count(1e4); ++i) {
        const Point3 p = Point3{} + random.in_cube(), q = p + random.in_cube(), r = p + random.in_cube();
        const Transform a = Transform::translate(random.in_cube(random.log_uniform(1e-3, 1e6))) * any_matrix(random);
        const Transform b = Transform::translate(random.in_cube(3)) * any_matrix(random);
        const Instance instance(std::make_shared<Triangle>(p, q, r, nullptr), a, b);
        const Box box = instance.bounds();
        for (int k = 0; k < 100; ++k) {
            const Transform m = interpolate(a, b, any_time(random));
            for (const Point3& corner : {p, q, r}) {
                const Real3 image = transform_point(m, Real3(corner));
                outside += image.x < Real(box.lower.x) || image.x > Real(box.upper.x) || image.y < Real(box.lower.y) ||
                           image.y > Real(box.upper.y) || image.z < Real(box.lower.z) || image.z > Real(box.upper.z);
            }
        }
    }
    CHECK(outside == 0);
}

}  // namespace limn::motion_test
