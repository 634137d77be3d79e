// Secondary rays leave a surface by its error bound: no self-hit outward, no lost exit inward, no lost thin gap, no
// false shadow. hardcases.md 2.4.
#include "catch.h"
#include "limn/render/compiled_scene.h"
#include "support/scene_zoo.h"
#include "support/tally.h"

using namespace limn;
using namespace limn::test;

namespace {

constexpr double kScales[] = {1e-4, 1e-2, 1, 1e2, 1e4, 1e6};
constexpr double kOffsets[] = {0, 10, 1000};  // in sizes of the object

struct Start {
    Ray ray;
    Surface surface;
};

// A point on the object, reached from outside.
std::optional<Start> reach(const CompiledScene& compiled, const Point3& aim, double size, Random& random) {
    const Point3 origin = aim + random.uniform(4, 10) * size * random.unit();
    const Ray ray{.origin = origin, .direction = random.log_uniform(0.1, 10) * (aim - origin)};
    const auto hit = compiled.closest_hit(ray);
    if (!hit) return std::nullopt;
    return Start{ray, compiled.surface_at(ray, *hit)};
}

// A direction on one side of the surface, often grazing.
Vec3 leaving_direction(Random& random, const Normal3& n, double side) {
    Vec3 d = random.unit();
    if (random.chance(0.3)) d = d - (1 - random.log_uniform(1e-6, 1)) * dot(n, d) * Vec3(n);
    d = normalize(d);
    return side * dot(n, d) < 0 ? -d : d;
}

}  // namespace

TEST_CASE("Leaving: a ray outward never hits the same sphere, triangle, quad or box again", "[compile][leaving]") {
    Random random(360);
    for (int shape = 0; shape < 4; ++shape) {
        for (const double scale : kScales) {
            for (const double offset : kOffsets) {
                const Point3 c = Point3{} + offset * scale * random.unit();
                Object object;
                if (shape == 0) object = ball(c, scale);
                if (shape == 1)
                    object =
                        std::make_shared<Triangle>(c, c + random.in_cube(scale), c + random.in_cube(scale), nullptr);
                if (shape == 2)
                    object = std::make_shared<Quad>(c, random.in_cube(scale), random.in_cube(scale), nullptr);
                if (shape == 3)
                    object = std::make_shared<Instance>(make_box({0, 0, 0}, {1, 1, 1}, nullptr),
                                                        Transform::translate(c - Point3{}) *
                                                            Transform::rotate({1, 2, 3}, 33) *
                                                            Transform::scale(scale, scale, scale));
                const CompiledScene compiled = compile(zoo_of("one", {object}).scene);
                Tally tally;
                for (int i = 0; i < 2000; ++i) {
                    const auto start = reach(compiled, random.in_box(object->bounds()), scale, random);
                    if (!start) continue;
                    ++tally.hits;
                    const Ray out = start->surface.spawn_ray(leaving_direction(random, start->surface.normal, 1), 0);
                    if (compiled.any_hit(out)) tally.fault(out, "hit itself");
                }
                INFO("shape " << shape << ", scale " << scale << ", offset " << offset << ": " << tally.first);
                CHECK(tally.wrong == 0);
                CHECK(tally.hits > 20);
            }
        }
    }
}

TEST_CASE("Leaving: a ray into a sphere finds its exit, and does not hit where it starts", "[compile][leaving]") {
    Random random(361);
    for (const double scale : kScales) {
        for (const double offset : kOffsets) {
            const Point3 c = Point3{} + offset * scale * random.unit();
            const CompiledScene compiled = compile(zoo_of("ball", {ball(c, scale)}).scene);
            Tally tally;
            for (int i = 0; i < 2000; ++i) {
                const auto start = reach(compiled, c + 0.99 * scale * random.unit(), scale, random);
                if (!start) continue;
                const Vec3 d = leaving_direction(random, start->surface.normal, -1);
                const double cosine = -dot(start->surface.normal, d);
                ++tally.hits;
                const Ray in = start->surface.spawn_ray(d, 0);
                const auto exit = compiled.closest_hit(in);
                if (!exit) tally.fault(in, "lost exit");
                // The chord, unless it is so flat that the offset from the surface lengthens it.
                else if (cosine * cosine > 1e-11 * (1 + offset) && std::abs(exit->t / (2 * cosine * scale) - 1) > 0.01)
                    tally.fault(in, "exit too near or too far");
                else if (compiled.surface_at(in, *exit).front_face)
                    tally.fault(in, "exit seen from outside");
            }
            INFO("scale " << scale << ", offset " << offset << ": " << tally.first);
            CHECK(tally.wrong == 0);
            CHECK(tally.hits > 1000);
        }
    }
}

TEST_CASE("Leaving: a ray into a closed box or mesh finds its exit", "[compile][leaving]") {
    Random random(362);
    for (const double scale : kScales) {
        for (const double offset : kOffsets) {
            const Vec3 shift = offset * scale * random.unit();
            for (int shape = 0; shape < 2; ++shape) {
                const MeshData data = icosphere(2, scale, shift);
                const Object object =
                    shape ? Object(std::make_shared<Mesh>(data, nullptr))
                          : Object(make_box(Point3{} + shift, Point3{} + shift + Vec3{scale, scale, scale}, nullptr));
                const CompiledScene compiled = compile(zoo_of("closed", {object}).scene);
                Tally tally;
                for (int i = 0; i < 500; ++i) {
                    const auto start = reach(compiled, random.in_box(object->bounds()), scale, random);
                    if (!start || !start->surface.front_face) continue;
                    Vec3 d = random.unit();
                    if (dot(start->surface.normal, d) > 0) d = -d;
                    const double cosine = -dot(start->surface.normal, d);
                    if (cosine < 0.1) continue;
                    // Not from a crease: there the offset may lie beyond the neighbouring face.
                    const Surface& s = start->surface;
                    if (shape == 1 && (s.uv.u < 1e-6 || s.uv.v < 1e-6 || s.uv.u + s.uv.v > 1 - 1e-6)) continue;
                    if (shape == 0 && (s.uv.u < 1e-6 || s.uv.v < 1e-6 || s.uv.u > 1 - 1e-6 || s.uv.v > 1 - 1e-6))
                        continue;
                    ++tally.hits;
                    const Ray in = s.spawn_ray(d, 0);
                    const auto exit = compiled.closest_hit(in);
                    if (!exit || compiled.surface_at(in, *exit).front_face) tally.fault(in, "lost exit");
                }
                INFO("shape " << shape << ", scale " << scale << ", offset " << offset << ": " << tally.first);
                CHECK(tally.wrong == 0);
                CHECK(tally.hits > 50);
            }
        }
    }
}

TEST_CASE("Leaving: rays off surfaces in nested instances do not hit them again", "[compile][leaving]") {
    Random random(363);
    const Object mesh = std::make_shared<Mesh>(icosphere(1), nullptr);
    for (const double scale : {1e-3, 1.0, 1e3}) {
        for (const double shift : {0.0, 1e3, 1e5}) {
            for (const Object& object : {ball({0, 0, 0}, 1), mesh}) {
                const Object inner =
                    std::make_shared<Instance>(object, Transform::rotate({3, 1, 2}, 50) * Transform::scale(1, 0.5, 2));
                const Object outer = std::make_shared<Instance>(
                    inner, Transform::translate(shift * random.unit()) * Transform::scale(scale, scale, scale));
                const CompiledScene compiled = compile(zoo_of("nested", {outer}).scene);
                Tally tally;
                for (int i = 0; i < 1000; ++i) {
                    const auto start =
                        reach(compiled, outer->bounds().center() + random.in_cube(0.4 * scale), 4 * scale, random);
                    if (!start || !start->surface.front_face) continue;
                    ++tally.hits;
                    const Ray out = start->surface.spawn_ray(leaving_direction(random, start->surface.normal, 1), 0);
                    if (compiled.any_hit(out)) tally.fault(out, "hit itself");
                }
                INFO("scale " << scale << ", shift " << shift << ": " << tally.first);
                CHECK(tally.wrong == 0);
                CHECK(tally.hits > 800);
            }
        }
    }
}

TEST_CASE("Leaving: a core under a shell, a gap of 4e-5 of the radius away, is always found", "[compile][leaving]") {
    Random random(364);
    for (const double scale : kScales) {
        for (const double offset : {0.0, 10.0}) {
            const Point3 c = Point3{} + offset * scale * random.unit();
            const CompiledScene compiled =
                compile(zoo_of("shell", {ball(c, scale), ball(c, scale * (1 + 4e-5))}).scene);
            Tally tally;
            for (int i = 0; i < 2000; ++i) {
                const auto start = reach(compiled, c + 0.5 * scale * random.unit(), scale, random);
                if (!start) continue;
                Vec3 d = random.unit();
                if (dot(start->surface.normal, d) > 0) d = -d;
                if (dot(start->surface.normal, d) > -0.1) continue;
                ++tally.hits;
                const Ray in = start->surface.spawn_ray(d, 0);
                const auto core = compiled.closest_hit(in);
                if (!core || core->object != 0) tally.fault(in, "core lost");
            }
            INFO("scale " << scale << ", offset " << offset << ": " << tally.first);
            CHECK(tally.wrong == 0);
            CHECK(tally.hits > 1000);
        }
    }
}

TEST_CASE("Leaving: a shadow ray between two surfaces with nothing between is unoccluded", "[compile][leaving]") {
    Random random(365);
    for (double distance = 1e-5; distance <= 2e5; distance *= 10) {
        // Two plates that face each other, turned at random, each larger than the gap.
        Tally tally;
        for (int set = 0; set < 20; ++set) {
            const double size = std::max(1.0, distance);
            const Vec3 n = random.unit(), e = normalize(cross(n, random.unit())), f = cross(n, e);
            const Point3 c = Point3{} + random.uniform(0, 10) * size * random.unit();
            const Object below = std::make_shared<Quad>(c - size * e - size * f, 2 * size * e, 2 * size * f, nullptr);
            const Object above = set % 2 ? Object(ball(c + (distance + 5 * size) * n, 5 * size))
                                         : Object(std::make_shared<Quad>(c + distance * n - size * e - size * f,
                                                                         2 * size * e, 2 * size * f, nullptr));
            const CompiledScene compiled = compile(zoo_of("plates", {below, above}).scene);
            for (int i = 0; i < 100; ++i) {
                const auto surface_towards = [&](const Vec3& d) -> std::optional<Surface> {
                    const Point3 origin = c + 0.5 * distance * n + random.uniform(-0.2, 0.2) * distance * e;
                    const Ray ray{.origin = origin, .direction = d + 0.7 * random.in_cube(0.5)};
                    const auto hit = compiled.closest_hit(ray);
                    if (!hit) return std::nullopt;
                    return compiled.surface_at(ray, *hit);
                };
                const auto a = surface_towards(-n), b = surface_towards(n);
                if (!a || !b || dot(a->normal, b->position - a->position) <= 0 ||
                    dot(b->normal, a->position - b->position) <= 0)
                    continue;
                if (set % 2 && dot(b->normal, normalize(a->position - b->position)) < 0.1) continue;
                ++tally.hits;
                for (const Ray& ray : {a->spawn_ray_to(*b, 0), b->spawn_ray_to(*a, 0), a->spawn_ray_to(b->position, 0),
                                       b->spawn_ray_to(a->position, 0)})
                    if (compiled.any_hit(ray)) tally.fault(ray, "false shadow");
            }
        }
        INFO("distance " << distance << ": " << tally.first);
        CHECK(tally.wrong == 0);
        CHECK(tally.hits > 1000);
    }
}

TEST_CASE("Leaving: a light that lies exactly in a wall is not shadowed by the wall, and what stands between shadows",
          "[compile][leaving]") {
    Random random(366);
    const Object wall = std::make_shared<Quad>(Point3{-10, 5, -10}, Vec3{20, 0, 0}, Vec3{0, 0, 20}, nullptr);
    const Object light = std::make_shared<Quad>(Point3{-1, 5, -1}, Vec3{2, 0, 0}, Vec3{0, 0, 2}, nullptr);
    const Object floor = std::make_shared<Quad>(Point3{-10, 0, -10}, Vec3{0, 0, 20}, Vec3{20, 0, 0}, nullptr);
    const CompiledScene open = compile(zoo_of("open", {wall, light, floor}).scene);
    const CompiledScene closed = compile(
        zoo_of("closed", {wall, light, floor,
                          std::make_shared<Quad>(Point3{-10, 4.9999, -10}, Vec3{20, 0, 0}, Vec3{0, 0, 20}, nullptr)})
            .scene);
    Tally tally;
    for (int i = 0; i < 20000; ++i) {
        const Ray down{.origin = {random.uniform(-9, 9), 1, random.uniform(-9, 9)}, .direction = {0.1, -1, 0.2}};
        const auto hit = open.closest_hit(down);
        REQUIRE(hit);
        const Surface s = open.surface_at(down, *hit);
        const Point3 on_light{random.uniform(-1, 1), 5, random.uniform(-1, 1)};
        if (open.any_hit(s.spawn_ray_to(on_light, 0))) tally.fault(s.spawn_ray_to(on_light, 0), "false shadow");
        if (!closed.any_hit(s.spawn_ray_to(on_light, 0))) tally.fault(s.spawn_ray_to(on_light, 0), "no shadow");
    }
    INFO(tally.first);
    CHECK(tally.wrong == 0);
}
