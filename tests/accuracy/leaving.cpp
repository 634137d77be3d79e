// Leaving a surface: rays that set out from a hit point must not hit the same surface again, must find the way out of a
// body, and must not pass through a thin gap's far side. How they set out is all that is compared: the second
// intersection is limn's in every column.
#include "accuracy/bodies.h"
#include "accuracy/groups.h"
#include "accuracy/ray_row.h"
#include "limn/scene/shape/instance.h"
#include "limn/scene/shape/quad.h"
#include "limn/scene/shape/sphere.h"
#include "limn/scene/shape/triangle.h"

namespace limn::accuracy {

namespace {

enum class Body { sphere, instance, mesh, triangle, quad };

// How a ray sets out.
struct Departure {
    const char* name;
    double t_min;   // 0: limn's error bounds
    bool to_float;  // the point is rounded to float32
};
constexpr Departure kDepartures[] = {{"limn, spawn_ray", 0, false},
                                     {"float32 point, t_min 1e-3", 1e-3, true},
                                     {"float32 point, t_min 1e-4", 1e-4, true},
                                     {"double point, t_min 1e-3", 1e-3, false}};
constexpr std::size_t kColumns = std::size(kDepartures);

Ray depart(const Departure& how, const Surface& from, const Ray& ray, double t, const Vec3& direction) {
    if (how.t_min == 0) return from.spawn_ray(direction, 0);
    const Point3 p = ray.at(t);
    return {.origin = how.to_float ? to_float(p) : p, .direction = direction, .t_min = how.t_min};
}

// A direction on the side of n, at least 0.01 off the surface: nearer to it, what is behind is as near as what the ray
// has to get away from.
Vec3 to_side(test::Random& random, const Vec3& n) {
    const double c = random.uniform(0.01, 1);
    return c * n + std::sqrt(1 - c * c) * across(random, n);
}

struct Place {
    Body body;
    double scale, away;  // of the body, and how many sizes it is from the origin
};

CompiledScene scene_of(const Place& place, test::Random& random, Point3& center) {
    center = to_float(Point3{} + place.scale * place.away * random.unit());
    Scene scene;
    const double s = to_float(place.scale);
    const auto corner = [&] { return to_float(center + s * random.unit()); };
    switch (place.body) {
        case Body::sphere: scene.add(std::make_shared<Sphere>(center, s, nullptr)); break;
        case Body::instance: {
            const Transform turned = Transform::rotate(random.unit(), random.uniform(0, 360));
            scene.add(std::make_shared<Instance>(
                std::make_shared<Sphere>(Point3{}, 1, nullptr),
                Transform::translate(center - Point3{}) * turned * Transform::scale(s, s, s)));
            break;
        }
        case Body::mesh: scene.add(std::make_shared<Mesh>(test::icosphere(2, s, center - Point3{}), nullptr)); break;
        case Body::triangle: scene.add(std::make_shared<Triangle>(corner(), corner(), corner(), nullptr)); break;
        case Body::quad: {
            const Vec3 u = random.unit();
            scene.add(std::make_shared<Quad>(center, to_float(s * u), to_float(s * across(random, u)), nullptr));
            break;
        }
    }
    return compile(scene);
}

// One hit point, left once outward and once inward, in every way.
void leave(const Place& place, test::Random& random, const CompiledScene& scene, const Point3& center, Row& sum) {
    std::optional<RayHit> hit;
    Ray ray;
    while (!hit) {  // the rays before do not count: they are looking for a point to leave
        ray = ray_through(center + 3 * place.scale * random.unit(), center + random.in_cube(place.scale));
        hit = scene.closest_hit(ray);
    }
    const Surface surface = scene.surface_at(ray, *hit);
    const Vec3 normal(surface.normal), out = to_side(random, normal), in = to_side(random, -normal);
    sum.rays += 2, sum.judged += 2;
    for (std::size_t k = 0; k < kColumns; ++k) {
        Cell& cell = sum.cells[k];
        cell.asked += 2;
        cell.self_hits += scene.any_hit(depart(kDepartures[k], surface, ray, hit->t, out));
        const auto behind = scene.closest_hit(depart(kDepartures[k], surface, ray, hit->t, in));
        if (place.body == Body::triangle || place.body == Body::quad) {
            cell.self_hits += behind.has_value();
        } else if (!behind) {
            ++cell.lost;
        } else if (place.body == Body::mesh) {
            cell.self_hits += behind->element == hit->element;
        } else {  // the chord is 2 r cos long
            cell.self_hits += behind->t < place.scale * dot(in, -normal);
        }
    }
}

// A sphere with a core 4e-5 of its radius below the surface, entered straight: the core must be next.
void enter_gap(const Place& place, test::Random& random, const CompiledScene& scene, const Point3& center, Row& sum) {
    const Ray ray = ray_through(center + 3 * place.scale * random.unit(), center);
    const auto hit = scene.closest_hit(ray);
    ++sum.rays, ++sum.judged;
    for (Cell& cell : sum.cells) ++cell.asked;
    if (!hit || hit->object != 0) return ++sum.cells[0].lost, void();
    const Surface surface = scene.surface_at(ray, *hit);
    for (std::size_t k = 0; k < kColumns; ++k) {
        const auto next = scene.closest_hit(depart(kDepartures[k], surface, ray, hit->t, normalize(ray.direction)));
        sum.cells[k].lost += !next || next->t > 0.5 * place.scale;
        sum.cells[k].self_hits += next && next->object == 0;
    }
}

CompiledScene shell(const Place& place, test::Random& random, Point3& center) {
    center = to_float(Point3{} + place.scale * place.away * random.unit());
    Scene scene;
    const double core = to_float(place.scale);
    scene.add(std::make_shared<Sphere>(center, to_float(core * (1 + 4e-5)), nullptr));
    scene.add(std::make_shared<Sphere>(center, core, nullptr));
    return compile(scene);
}

using Make = CompiledScene (*)(const Place&, test::Random&, Point3&);
using Try = void (*)(const Place&, test::Random&, const CompiledScene&, const Point3&, Row&);

Row row_of(const std::string& name, const Place& place, const Effort& effort, std::uint64_t rays, Make make, Try once) {
    note("leaving: " + name);
    Row empty;
    empty.name = name;
    empty.x = place.scale;
    empty.cells.resize(kColumns);
    const std::size_t rays_each = once == leave ? 2 : 1;
    return add_up(empty, rays / rays_each, 256, effort.threads, [&]() -> Work {
        return [&](std::uint64_t chunk, std::size_t count, Row& sum) {
            test::Random random(seed_of(name, chunk));
            Point3 center;
            const CompiledScene scene = make(place, random, center);
            for (std::size_t i = 0; i < count; ++i) once(place, random, scene, center, sum);
        };
    });
}

}  // namespace

Group leaving_group(const Effort& effort) {
    Group group{"leaving", "leaving", {}, {}};
    for (const Departure& how : kDepartures) group.columns.emplace_back(how.name);
    const std::pair<Body, const char*> bodies[] = {{Body::sphere, "sphere"},
                                                   {Body::instance, "sphere in an instance"},
                                                   {Body::mesh, "icosphere"},
                                                   {Body::triangle, "triangle"},
                                                   {Body::quad, "quad"}};
    for (const auto& [body, name] : bodies)
        for (const double away : {0.0, 10.0, 1000.0})
            for (const double scale : {1e-4, 1.0, 1e2, 1e4, 1e6})
                group.rows.push_back(row_of(std::string(name) + named(" of size %.0e at %.0f sizes", scale, away),
                                            {body, scale, away}, effort, effort.rays / 10, scene_of, leave));
    for (const double away : {0.0, 10.0})
        for (const double scale : {1e-4, 1e-2, 1.0, 1e2, 1e4})
            group.rows.push_back(row_of(named("gap of 4e-5 radii under a sphere of %.0e at %.0f sizes", scale, away),
                                        {Body::sphere, scale, away}, effort, effort.rays / 10, shell, enter_gap));
    return group;
}

}  // namespace limn::accuracy
