// Instances: the exact image of the shape under the stored matrices, however deep, skewed, mirrored or far.
#include "catch.h"
#include "geometry/ray_frame.h"
#include "hard/placed.h"
#include "limn/math/error.h"
#include "limn/render/render.h"
#include "limn/scene/material/dielectric.h"

namespace limn::instance_test {

using namespace test;

namespace {

Placed random_placed(Random& random, Placed::Kind kind) {
    Placed placed{.kind = kind};
    if (kind == Placed::Kind::mesh) {
        placed.mesh = random.chance(0.5) ? cube_mesh() : icosphere(0);
        return placed;
    }
    placed.p = Point3{} + random.in_cube();
    placed.e = random.in_cube(), placed.f = random.in_cube();
    placed.radius = random.uniform(0.2, 1.5);
    return placed;
}

Transform random_matrix(Random& random) {
    Transform m;
    for (auto& row : m.rows)
        for (std::size_t j = 0; j < 3; ++j) row[j] = random.uniform(-1, 1);
    for (std::size_t i = 0; i < 3; ++i) m.rows[i][i] += 1.5 * random.sign();
    return m;
}

constexpr Placed::Kind kKinds[] = {Placed::Kind::sphere, Placed::Kind::triangle, Placed::Kind::quad,
                                   Placed::Kind::mesh};
constexpr const char* kNames[] = {"sphere", "triangle", "quad", "mesh"};

// `rays` rays at each kind of shape under matrices that `place` writes, a new placement every twenty rays.
template <class Place>
void judge_placements(const std::string& row, int rays, std::uint64_t seed, const Place& place) {
    for (const Placed::Kind kind : kKinds) {
        Random random(seed + static_cast<std::uint64_t>(kind));
        Tally tally;
        for (int i = 0; i < rays; i += 20) {
            Placed placed = random_placed(random, kind);
            place(random, placed);
            const BothWorlds worlds(placed.object(), {ball({0, 0, -2000}, 1), ball({0, 3000, 0}, 1)});
            const std::vector<Point3> points = placed.awkward_points();
            Box around;
            for (const Point3& p : points) around.extend(p);
            for (int k = 0; k < 20; ++k)
                judge(tally, placed, worlds, aimed_ray(random, placed, points, max_abs(around.diagonal())));
        }
        check(tally, row + ", " + kNames[static_cast<int>(kind)]);
        CHECK(tally.hits > tally.rays / 10);
    }
}

Vec3 permuted(const Vec3& v, const std::array<std::size_t, 3>& order, int mirror) {
    Vec3 out;
    for (std::size_t a = 0; a < 3; ++a) out[a] = (mirror >> a) & 1 ? -v[order[a]] : v[order[a]];
    return out;
}

}  // namespace

TEST_CASE("Instance: a sphere of 1e-3, 1 or 1e3, up to 1e5 away, is hit as in exact arithmetic", "[hard][instance]") {
    for (const double size : {1e-3, 1.0, 1e3})
        for (const double place : {0.0, 1e3, 1e5}) {
            Random random(3600);
            const Vec3 shift = place * random.unit();
            const Placed placed{.chain = {Transform::translate(shift) * Transform::scale(size, size, size)}};
            const BothWorlds worlds(placed.object(), {ball({0, -5000, 0}, 1)});
            Tally tally;
            for (int i = 0; i < count(1e6) / 2; ++i) {
                const Vec3 away = random.unit();
                const Point3 center = Point3{} + shift, origin = center + 10 * size * away;
                // A third within the outline, a third about it, a third beside the tangent by an ulp and more.
                const Vec3 aside = normalize(cross(away, random.unit()));
                const double grazing = 10 / std::sqrt(99.0);
                const double reach = i % 3 == 0   ? random.uniform()
                                     : i % 3 == 1 ? random.uniform(0.99, 1.02)
                                                  : grazing * (1 + random.sign() * random.log_uniform(1e-16, 1e-6));
                judge(tally, placed, worlds, {.origin = origin, .direction = (center + reach * size * aside) - origin});
            }
            check(tally, "size " + std::to_string(size) + " at " + std::to_string(place));
            CHECK(tally.hits > tally.rays / 3);
        }
}

TEST_CASE("Instance: nested to depth 1 to 4, and to 16, vertices, edges and outlines are decided exactly",
          "[hard][instance]") {
    for (const int depth : {1, 2, 3, 4, 16})
        judge_placements(
            "depth " + std::to_string(depth), count(depth > 4 ? 1e4 : 1e5), 3610, [&](Random& random, Placed& placed) {
                for (int i = 0; i < depth; ++i)
                    placed.chain.push_back(Transform::translate(random.in_cube(3)) * random_matrix(random));
            });
}

TEST_CASE("Instance: mirrored, stretched by 1e-3 and 1e3 and sheared, they are decided exactly", "[hard][instance]") {
    judge_placements("mirrored", count(1e5), 3620, [](Random& random, Placed& placed) {
        placed.chain = {Transform::scale(-1, 1, 1) * random_matrix(random), Transform::scale(1, -2, 1)};
    });
    judge_placements("stretched and sheared", count(1e5), 3630, [](Random& random, Placed& placed) {
        Transform shear;
        shear.rows[0][1] = random.uniform(-3, 3), shear.rows[1][2] = random.uniform(-3, 3);
        placed.chain = {Transform::rotate(random.unit(), 50) * Transform::scale(1, 1e-3, 1e3) * shear};
    });
}

TEST_CASE("Instance: moved by up to 1e8 and of sizes from 1e-6 to 1e6, they are decided exactly", "[hard][instance]") {
    judge_placements("far away", count(1e5), 3640, [](Random& random, Placed& placed) {
        const double place = random.log_uniform(1, 1e8), size = random.log_uniform(1e-3, 1e3);
        placed.chain = {Transform::translate(place * random.unit()) * Transform::scale(size, size, size),
                        Transform::rotate(random.unit(), 77)};
    });
    judge_placements("sizes", count(1e5), 3650, [](Random& random, Placed& placed) {
        const double size = random.log_uniform(1e-6, 1e6);
        placed.chain = {Transform::rotate(random.unit(), 77) * Transform::scale(size, size, size),
                        Transform::translate(random.in_cube(10)) * random_matrix(random)};
    });
    judge_placements("there and back", count(1e5), 3660, [](Random& random, Placed& placed) {
        const Vec3 by = random.log_uniform(1, 1e6) * random.unit();
        placed.chain = {Transform::translate(by), random_matrix(random), Transform::translate(-by)};
    });
}

TEST_CASE("Instance: a matrix near to singular is decided exactly too", "[hard][instance]") {
    judge_placements("near to singular", count(1e5), 3670, [](Random& random, Placed& placed) {
        Transform m;
        do {
            m = random_matrix(random);
            const double off = random.log_uniform(1e-16, 1e-3);
            for (std::size_t j = 0; j < 3; ++j) m.rows[2][j] = m.rows[0][j] + off * random.uniform(-1, 1);
        } while (is_singular(m) || determinant(m) == 0);  // refused
        placed.chain = {Transform::translate(random.in_cube(3)) * m};
    });
}

TEST_CASE("Instance: eight turns of 45 degrees one in the other show the plain object, t within four ulp",
          "[hard][instance]") {
    Random random(3700);
    for (const Placed::Kind kind : kKinds) {
        Placed placed = random_placed(random, kind);
        const Object plain = placed.shape();
        for (int i = 0; i < 8; ++i) placed.chain.push_back(Transform::rotate({1, 2, 3}, 45));
        const BothWorlds worlds(placed.object());
        Tally tally, apart;
        for (int i = 0; i < count(5e4); ++i) {
            const Point3 target = placed.point_on(random, false);
            Ray ray;
            ray.origin = target + 5.0 * random.unit();
            ray.direction = target - ray.origin;
            judge(tally, placed, worlds, ray);
            // Well within the shape, where 8 roundings of the matrices do not matter.
            const auto a = worlds.hit(ray, apart), b = worlds.hit(ray, apart);
            const auto shown = plain->hit(ray);
            ++apart.rays, ++apart.judged;
            if (a && b && shown && std::abs(a->t - shown->t) > 4 * 0x1p-23 * std::abs(shown->t) &&
                std::abs(dot(shown->normal, normalize(ray.direction))) > 0.01 && a->element == shown->element)
                apart.fault(ray, "t");
        }
        check(tally, std::string("eight turns, ") + kNames[static_cast<int>(kind)]);
        check(apart, std::string("plain, ") + kNames[static_cast<int>(kind)]);
    }
}

TEST_CASE("Instance: the 48 permutations and mirrorings of the axes change no decision", "[hard][instance]") {
    const std::array<std::size_t, 3> orders[] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (const Placed::Kind kind : kKinds) {
        Tally tally;
        Random random(3710);
        for (const auto& order : orders)
            for (int mirror = 0; mirror < 8; ++mirror) {
                Placed placed = random_placed(random, kind);
                const Object plain = placed.shape();
                const std::vector<Point3> points = placed.awkward_points();
                Transform m;
                for (std::size_t a = 0; a < 3; ++a)
                    for (std::size_t b = 0; b < 3; ++b) m.rows[a][b] = order[a] == b ? ((mirror >> a) & 1 ? -1 : 1) : 0;
                placed.chain = {m};
                const BothWorlds worlds(placed.object());
                for (int i = 0; i < count(1e5) / 10; ++i) {
                    const Ray ray = aimed_ray(random, placed.shape_alone(), points, 1);
                    Ray turned = ray;
                    turned.origin = Point3{} + permuted(ray.origin - Point3{}, order, mirror);
                    turned.direction = permuted(ray.direction, order, mirror);
                    judge(tally, placed, worlds, turned);
                    if (plain->hit(ray).has_value() != worlds.hit(turned, tally).has_value())
                        tally.fault(turned, "otherwise than the plain object");
                }
            }
        check(tally, kNames[static_cast<int>(kind)]);
        CHECK(tally.hits > tally.rays / 4);
    }
}

TEST_CASE("Instance: a normal is turned by the inverse transpose, to 1e-6 rad, under stretching and shear",
          "[hard][instance]") {
    Random random(3800);
    for (const Placed::Kind kind : {Placed::Kind::sphere, Placed::Kind::triangle, Placed::Kind::quad}) {
        Tally tally;
        for (int i = 0; i < count(1e6) / 10; ++i) {
            Placed placed = random_placed(random, kind);
            Transform m = Transform::scale(1, 1e-3, 1e3);
            m.rows[0][1] = random.uniform(-1, 1), m.rows[2][0] = random.uniform(-1, 1);
            if (random.chance(0.5)) m = Transform::scale(-1, 1, 1) * m;
            placed.chain = {Transform::translate(random.in_cube(5)) * m};
            const Object object = placed.object();
            const CompiledScene compiled = compile(zoo_of("one", {object}).scene);
            const Point3 target = placed.point_on(random, false);
            Ray ray;
            ray.origin = target + (placed.to_world(placed.p + 3 * random.unit()) - placed.to_world(placed.p));
            ray.direction = target - ray.origin;
            ++tally.rays, ++tally.judged;
            const auto hit = object->hit(ray);
            const auto found = compiled.closest_hit(ray);
            if (!hit || !found) {
                if (kind != Placed::Kind::sphere) tally.fault(ray, "missed");
                continue;
            }
            ++tally.hits;
            // M^-T is the matrix of cofactors over the determinant.
            const Transform& world = placed.chain.front();
            Real3 rows[3], cofactors[3];
            for (std::size_t r = 0; r < 3; ++r) rows[r] = {world.rows[r][0], world.rows[r][1], world.rows[r][2]};
            for (std::size_t r = 0; r < 3; ++r) cofactors[r] = cross(rows[(r + 1) % 3], rows[(r + 2) % 3]);
            const Real det = dot(rows[0], cofactors[0]);
            Real3 local(cross(placed.e, placed.f));
            if (kind == Placed::Kind::sphere) {  // M^-1 (o + t d - translation) - centre, times det
                const Real3 at = Real3(ray.origin) + Real(hit->t) * Real3(ray.direction) - Real3(world.translation());
                local = at.x * cofactors[0] + at.y * cofactors[1] + at.z * cofactors[2];
                local = (1 / det) * local - Real3(placed.p);
            } else {
                local = cross(Real3(placed.e), Real3(placed.f));
            }
            Real3 normal{dot(cofactors[0], local), dot(cofactors[1], local), dot(cofactors[2], local)};
            if (det < 0) normal = Real(-1) * normal;
            const auto off = [&](const Normal3& n) {
                return length(cross(Real3(n), normal)) > Real(1e-6) * length(normal) || dot(Real3(n), normal) < 0;
            };
            const Surface s = compiled.surface_at(ray, *found);
            if (off(hit->normal)) tally.fault(ray, "normal of the described");
            if (off(s.front_face ? s.normal : -s.normal)) tally.fault(ray, "normal of the compiled");
        }
        check(tally, kNames[static_cast<int>(kind)]);
        CHECK(tally.hits > tally.rays / 2);
    }
}

TEST_CASE(
    "Instance: out of a box of six quads or of twelve triangles, turned, skewed and far away, no ray leaks at a "
    "corner or an edge",
    "[hard][instance]") {
    const Object boxes[] = {make_box({0, 0, 0}, {1, 1, 1}, nullptr), std::make_shared<Mesh>(cube_mesh(), nullptr)};
    for (const Object& box : boxes)
        for (const double place : {0.0, 1e3, 1e5, 1e9}) {
            Random random(3690);
            Tally tally;
            for (int set = 0; set < 50; ++set) {
                const Transform outer = Transform::translate(place * random.unit()) *
                                        Transform::rotate(random.unit(), random.uniform(0, 360));
                const Transform inner = random_matrix(random);
                const BothWorlds worlds(std::make_shared<Instance>(std::make_shared<Instance>(box, inner), outer));
                const Placed placed{.kind = Placed::Kind::mesh, .mesh = cube_mesh(), .chain = {outer, inner}};
                const std::vector<Point3> points = placed.awkward_points();
                for (int i = 0; i < count(5e5) / 50; ++i) {
                    const Point3 inside{random.uniform(0.2, 0.8), random.uniform(0.2, 0.8), random.uniform(0.2, 0.8)};
                    const Point3 target = i % 2 ? points[random.index(8)] : placed.point_on(random, true);
                    Ray ray;
                    ray.origin = placed.to_world(inside);
                    ray.direction = target - ray.origin;
                    ++tally.rays, ++tally.judged;
                    if (!worlds.hit(ray, tally)) tally.fault(ray, "leak");
                }
            }
            check(tally, "at " + std::to_string(place));
        }
}

TEST_CASE("Instance: out of a box of six quads between any two corners no ray leaks", "[hard][instance]") {
    for (const double place : {0.0, 1.0, 1e3, 1e5}) {
        Random random(3695);
        Tally tally;
        for (int set = 0; set < 100; ++set) {
            const Point3 p = Point3{} + place * random.unit() + random.in_cube(), q = p + random.in_cube(2);
            const BothWorlds worlds(make_box(p, q, nullptr));
            const auto between = [&](double x, double y, double z) {
                return Point3{p.x + x * (q.x - p.x), p.y + y * (q.y - p.y), p.z + z * (q.z - p.z)};
            };
            for (int i = 0; i < count(1e6) / 100; ++i) {
                Point3 target = between(random.uniform(), random.uniform(), random.uniform());
                const std::size_t free_axis = i % 2 ? 3 : random.index(3);  // an edge's own axis; 3: a corner
                for (std::size_t a = 0; a < 3; ++a)
                    if (a != free_axis) target[a] = random.chance(0.5) ? p[a] : q[a];
                Ray ray;
                ray.origin = between(random.uniform(0.2, 0.8), random.uniform(0.2, 0.8), random.uniform(0.2, 0.8));
                ray.direction = target - ray.origin;
                ++tally.rays, ++tally.judged;
                if (!worlds.hit(ray, tally)) tally.fault(ray, "leak");
            }
        }
        check(tally, "at " + std::to_string(place));
    }
}

TEST_CASE("Instance: mirrored glass in a uniform field is as invisible as plain glass, and its outside is outside",
          "[hard][instance]") {
    for (const Transform& m : {Transform{}, Transform::scale(-1, 1, 1), Transform::scale(-1, -1, -1),
                               Transform::rotate({1, 2, 3}, 40) * Transform::scale(1, -1.5, 1)}) {
        Scene scene;
        scene.background = Background::constant(Color{1, 1, 1});
        scene.add(std::make_shared<Instance>(
            std::make_shared<Sphere>(Point3{0, 0, 0}, 1.0, std::make_shared<Dielectric>(1.5)), m));
        const CompiledScene compiled = compile(scene);
        const Ray in{.origin = {0, 0, 5}, .direction = {0.1, 0.05, -1}};
        const auto front = compiled.closest_hit(in);
        REQUIRE(front);
        CHECK(compiled.surface_at(in, *front).front_face);
        const Ray out{.origin = {0, 0, 0}, .direction = {0.1, 0.05, -1}};
        const auto back = compiled.closest_hit(out);
        REQUIRE(back);
        CHECK_FALSE(compiled.surface_at(out, *back).front_face);

        const Image image = render(compiled, {.look_from = {0, 0, 5}, .look_at = {0, 0, 0}, .vertical_fov = 40},
                                   {.width = 24, .height = 24, .samples_per_pixel = 16, .max_depth = 1000})
                                .image;
        double worst = 0;
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x) worst = std::max(worst, std::abs(image.at(x, y).g - 1.0));
        CHECK(worst < 1e-3);
    }
}

TEST_CASE("Instance: a singular matrix, or one with NaN or an infinity, is refused", "[hard][instance]") {
    const Object object = ball({0, 0, 0}, 1);
    Transform parallel;
    parallel.rows[1] = {2, 0, 0, 5};
    for (const Transform& m : {Transform::scale(1, 0, 1), parallel, Transform::scale(0, 0, 0)}) {
        CHECK_THROWS_AS(Instance(object, m), ArgumentError);
        CHECK_THROWS_AS(Instance(object, Transform{}, m), ArgumentError);
        CHECK_THROWS_AS(Instance(object, m, Transform{}), ArgumentError);
    }
    for (const double bad : {std::nan(""), kInfinity, -kInfinity})
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 4; ++j) {
                Transform m;
                m.rows[i][j] = bad;
                CHECK_THROWS_AS(Instance(object, m), ArgumentError);
                CHECK_THROWS_AS(Instance(object, m, Transform{}), ArgumentError);
                CHECK_THROWS_AS(Instance(object, Transform{}, m), ArgumentError);
            }
}

}  // namespace limn::instance_test
