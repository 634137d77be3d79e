// Rays that leave a surface by its error bound: none hits again where it starts, none loses its way out or jumps over a
// thin gap, no shadow falls where nothing stands between. From sizes of 1e-4 to 1e6, near and far from the origin,
// through instances, and on a ground that is a huge sphere.
#include "hard/leaving.h"
#include "catch.h"
#include "limn/render/render.h"
#include "limn/scene/material/lambertian.h"

namespace limn::leaving_test {

using namespace test;

namespace {

constexpr double kOffsets[] = {0, 10, 1000};  // from the origin, in sizes of the object

constexpr SubjectKind kKinds[] = {
    SubjectKind::sphere,        SubjectKind::triangle,         SubjectKind::quad,           SubjectKind::box,
    SubjectKind::mesh,          SubjectKind::instanced_sphere, SubjectKind::instanced_quad, SubjectKind::instanced_mesh,
    SubjectKind::moving_sphere, SubjectKind::moving_mesh};

std::string row(const std::string& name, double scale, double offset) {
    return name + ", scale " + std::to_string(scale) + ", offset " + std::to_string(offset);
}

// Two parallel plates, `gap` apart along n, each half a `size` to every side; sized so that all of `spread` is inside.
Object plate(const Point3& middle, const Vec3& e, const Vec3& f, double half_side) {
    return std::make_shared<Quad>(middle - half_side * (e + f), 2 * half_side * e, 2 * half_side * f, nullptr);
}

Object plate_mesh(const Point3& middle, const Vec3& e, const Vec3& f, double half_side) {
    MeshData data;
    for (const Vec3& corner : {-1.0 * (e + f), e - f, f - e, e + f})
        data.vertices.push_back(to_float3(middle - Point3{} + half_side * corner));
    data.triangles = {{0, 1, 2}, {1, 3, 2}};
    return std::make_shared<Mesh>(data, nullptr);
}

}  // namespace

TEST_CASE(
    "Leaving: off a sphere, triangle, quad, box, mesh or instance of size 1e-4 to 1e6, no ray hits it again, and "
    "every ray inward finds its way out",
    "[hard][leaving]") {
    for (const SubjectKind kind : kKinds) {
        Random random(4200 + static_cast<std::uint64_t>(kind));
        const int rays = kind <= SubjectKind::quad ? count(1e6) : count(1e5);  // a million for those that row 42 names
        for (double scale = 1e-4; scale < 2e6; scale *= 10)
            for (const double offset : kOffsets) {
                const Subject subject(kind, scale, Point3{} + offset * scale * random.unit(), random);
                Tally tally;
                for (int i = 0; i < rays; ++i) {
                    const auto surface = subject.reach(random, tally);
                    if (!surface) continue;
                    const double side = i % 2 ? 1 : -1;
                    const Vec3 direction = leaving_direction(random, surface->normal, side);
                    const Ray ray = surface->spawn_ray(direction, subject.time());
                    subject.judge(ray, side < 0 && subject.is_closed(), tally);
                }
                check(tally, row(subject.name(), scale, offset));
            }
    }
}

TEST_CASE("Leaving: a sphere's chord from where a ray entered has the length of the exact one", "[hard][leaving]") {
    Random random(4210);
    for (double scale = 1e-4; scale < 2e6; scale *= 100)
        for (const double offset : kOffsets) {
            const Subject subject(SubjectKind::sphere, scale, Point3{} + offset * scale * random.unit(), random);
            Tally tally;
            for (int i = 0; i < count(1e6) / 4; ++i) {
                const auto surface = subject.reach(random, tally);
                if (!surface) continue;
                const Vec3 d = leaving_direction(random, surface->normal, -1);
                const double chord = -2 * dot(surface->normal, d) * scale;
                const auto exit = subject.compiled().closest_hit(surface->spawn_ray(d, 0));
                // Moved off the surface by e, the chord is off by e / cosine: 64 roundings of the coordinates or so.
                const double moved = 64 * 0x1p-53 * (1 + offset) * scale / (chord / (2 * scale));
                if (!exit || std::abs(exit->t - chord) > 1e-9 * chord + 2 * moved)
                    tally.fault(surface->spawn_ray(d, 0), "chord");
            }
            check(tally, row("chord", scale, offset));
        }
}

TEST_CASE(
    "Leaving: a core under a shell, 4e-5 of the radius away, a plate behind a plate and a mesh in a mesh, 1e-4 "
    "away, are always found",
    "[hard][leaving]") {
    Random random(4300);
    for (double scale = 1e-4; scale < 2e6; scale *= 10)
        for (const double offset : {0.0, 10.0}) {
            const Point3 c = Point3{} + offset * scale * random.unit();
            const Transform skewed = Transform::translate(c - Point3{}) * Transform::rotate({1, 2, 3}, 25) *
                                     Transform::scale(scale, 0.8 * scale, 1.2 * scale);
            // An inner and an outer one of each kind; with float32 vertices 1e-4 is some hundred roundings.
            const Object unit = ball({0, 0, 0}, 1), shell = ball({0, 0, 0}, 1 + 4e-5);
            const std::pair<Object, Object> pairs[] = {
                {ball(c, scale), ball(c, scale * (1 + 4e-5))},
                {std::make_shared<Instance>(unit, skewed), std::make_shared<Instance>(shell, skewed)},
                {std::make_shared<Mesh>(icosphere(1, scale, c - Point3{}), nullptr),
                 std::make_shared<Mesh>(icosphere(1, scale * (1 + 4e-4), c - Point3{}), nullptr)},
                {plate(c, {0, 1, 0}, {0, 0, 1}, scale),
                 plate(c + Vec3{1e-4 * scale, 0, 0}, {0, 1, 0}, {0, 0, 1}, scale)},
            };
            for (std::size_t k = 0; k < std::size(pairs); ++k) {
                const CompiledScene compiled = compile(zoo_of("gap", {pairs[k].first, pairs[k].second}).scene);
                Tally tally;
                for (int i = 0; i < count(1e6) / 10; ++i) {
                    ++tally.rays, ++tally.judged;
                    // Towards the middle from the side of the outer one; plates are met near theirs.
                    const Vec3 from = k == 3 ? normalize(Vec3{1, 0, 0} + random.in_cube(0.3)) : random.unit();
                    const Point3 aim = c + 0.1 * scale * random.unit();
                    const Ray reach{.origin = aim + 5 * scale * from, .direction = aim - (aim + 5 * scale * from)};
                    const auto hit = compiled.closest_hit(reach);
                    if (!hit || hit->object != 1) {
                        tally.fault(reach, "outer one lost");
                        continue;
                    }
                    const Surface s = compiled.surface_at(reach, *hit);
                    Vec3 d;
                    do d = normalize(aim - s.position + (k == 2 ? 0.3 : 2) * scale * random.in_cube());
                    while (dot(s.normal, d) > -0.15);
                    const Ray in = s.spawn_ray(d, 0);
                    const auto core = compiled.closest_hit(in);
                    if (!core || core->object != 0 || !pairs[k].first->hit(in)) tally.fault(in, "inner one lost");
                }
                check(tally, row("pair " + std::to_string(k), scale, offset));
            }
        }
}

TEST_CASE("Leaving: between two surfaces 1e-5 to 1e5 apart with nothing between, no shadow falls", "[hard][leaving]") {
    Random random(4500);
    for (double distance = 1e-5; distance < 2e5; distance *= 10) {
        Tally tally;
        const int sets = 40, rays = count(1e7) / 11 / sets;
        for (int set = 0; set < sets; ++set) {
            const double size = std::max(1.0, distance);
            const Vec3 n = random.unit(), e = normalize(cross(n, random.unit())), f = cross(n, e);
            const Point3 c = Point3{} + random.uniform(0, 10) * size * random.unit(), over = c + distance * n;
            Object below = plate(c, e, f, size), above = plate(over, e, f, size);
            if (set % 4 == 1) above = ball(over + 5 * size * n, 5 * size);
            if (set % 4 == 2 && distance > 1e-3) below = plate_mesh(c, e, f, size);  // float32 vertices fit no closer
            if (set % 4 == 3) {
                const Transform m = Transform::translate(over - Point3{}) * Transform::rotate({3, 1, 2}, 70);
                const Transform back = inverse(m);
                const auto local = [&](const Vec3& v) { return transform_vector(back, v); };
                above = std::make_shared<Instance>(plate({0, 0, 0}, local(e), local(f), size), m);
            }
            const CompiledScene compiled = compile(zoo_of("plates", {below, above}).scene);
            const auto surface_towards = [&](const Vec3& d) -> std::optional<Surface> {
                const Ray ray{.origin = c + 0.5 * distance * n + random.uniform(-0.2, 0.2) * distance * e,
                              .direction = d + 0.7 * random.in_cube(0.5)};
                const auto hit = compiled.closest_hit(ray);
                if (!hit) return std::nullopt;
                return compiled.surface_at(ray, *hit);
            };
            for (int i = 0; i < rays; ++i) {
                const auto a = surface_towards(-n), b = surface_towards(n);
                ++tally.rays, ++tally.judged;
                if (!a || !b) {
                    tally.fault({.origin = c, .direction = n}, "plate lost");
                    continue;
                }
                ++tally.hits;
                for (const Ray& ray : {a->spawn_ray_to(*b, 0), b->spawn_ray_to(*a, 0)})
                    if (compiled.any_hit(ray) || below->hit(ray) || above->hit(ray)) tally.fault(ray, "false shadow");
            }
        }
        check(tally, "distance " + std::to_string(distance));
    }
}

TEST_CASE("Leaving: between any two points of the inside of a sphere no shadow falls", "[hard][leaving]") {
    Random random(4510);
    for (double scale = 1e-4; scale < 2e6; scale *= 10)
        for (const double offset : {0.0, 10.0}) {
            const Point3 c = Point3{} + offset * scale * random.unit();
            const Object object = ball(c, scale);
            const CompiledScene compiled = compile(zoo_of("inside", {object}).scene);
            Tally tally;
            for (int i = 0; i < count(1e6) / 4; ++i) {
                std::optional<Surface> ends[2];
                const Vec3 towards = random.unit();
                for (auto& end : ends) {
                    const double apart = (&end == ends) ? 0 : random.log_uniform(1e-2, 2);
                    const Ray ray{.origin = c, .direction = towards + apart * random.unit()};
                    if (const auto hit = compiled.closest_hit(ray)) end = compiled.surface_at(ray, *hit);
                }
                ++tally.rays, ++tally.judged;
                if (!ends[0] || !ends[1]) {
                    tally.fault({.origin = c, .direction = towards}, "leak");
                    continue;
                }
                const Ray between = ends[0]->spawn_ray_to(*ends[1], 0);
                if (compiled.any_hit(between) || object->hit(between)) tally.fault(between, "false shadow");
            }
            check(tally, row("inside", scale, offset));
        }
}

TEST_CASE("Leaving: a light that lies exactly in a wall is not shadowed by the wall, and what stands between shadows",
          "[hard][leaving]") {
    Random random(4520);
    for (double scale = 1e-4; scale < 2e6; scale *= 100) {
        const auto slab = [&](double y, double half_side) {
            return std::make_shared<Quad>(Point3{-half_side * scale, y * scale, -half_side * scale},
                                          Vec3{2 * half_side * scale, 0, 0}, Vec3{0, 0, 2 * half_side * scale},
                                          nullptr);
        };
        const CompiledScene open = compile(zoo_of("open", {slab(5, 10), slab(5, 1), slab(0, 10)}).scene);
        const CompiledScene closed =
            compile(zoo_of("closed", {slab(5, 10), slab(5, 1), slab(0, 10), slab(4.9999, 10)}).scene);
        Tally tally;
        for (int i = 0; i < count(1e6); ++i) {
            const double x = random.uniform(-9, 9), z = random.uniform(-9, 9);
            const Ray down{.origin = {x * scale, scale, z * scale}, .direction = {0.1, -1, 0.2}};
            ++tally.rays, ++tally.judged;
            const auto hit = open.closest_hit(down);
            if (!hit) {
                tally.fault(down, "floor lost");
                continue;
            }
            const Surface s = open.surface_at(down, *hit);
            const double on_x = random.uniform(-1, 1), on_z = random.uniform(-1, 1);
            const Ray shadow = s.spawn_ray_to(Point3{on_x * scale, 5 * scale, on_z * scale}, 0);
            if (open.any_hit(shadow)) tally.fault(shadow, "false shadow");
            if (!closed.any_hit(shadow)) tally.fault(shadow, "no shadow");
        }
        check(tally, row("light in a wall", scale, 0));
    }
}

TEST_CASE("Leaving: a diffuse ground sphere of radius 1e3 to 1e7 in a uniform field shows its albedo times the field",
          "[hard][leaving]") {
    for (double radius = 1e3; radius < 2e7; radius *= 10) {
        Scene scene;
        scene.background = Background::constant(Color{2, 2, 2});
        scene.add(std::make_shared<Sphere>(Point3{0, -radius, 0}, radius,
                                           std::make_shared<Lambertian>(Color{0.5, 0.5, 0.5})));
        const Camera camera{.look_from = {0, 1, 0}, .look_at = {1, 0, 0}, .vertical_fov = 40};
        const Image image =
            render(compile(scene), camera, {.width = 32, .height = 32, .samples_per_pixel = count(1600)}).image;
        double worst = 0;
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) worst = std::max(worst, std::abs(image.at(x, y).g - 1.0));
        INFO("radius " << radius);
        CHECK(worst < 1e-3);
    }
}

}  // namespace limn::leaving_test
