// Every entry into limn whose results are exact, or enter a picture: in each floating-point environment that a caller
// may have it returns the bits of the default one. An entry that does not set its environment fails here.
#if defined(__x86_64__)

#include <oneapi/tbb/task_arena.h>

#include <bit>
#include <concepts>
#include <cstring>

#include "flat/scene.h"
#include "hard/float_environments.h"
#include "hard/hard.h"
#include "limn/query/normals.h"
#include "limn/render/first_hits.h"
#include "limn/render/render_job.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/shape/disk.h"
#include "support/scene_zoo.h"

namespace limn::entries_test {

using namespace test;

namespace {

constexpr double kTiny = 0x1p-1040;  // subnormal

// The results of an entry as bits. Adding one computes nothing, so it can be done in any environment.
struct Results {
    std::vector<std::uint64_t> bits;

    void add(double x) { bits.push_back(std::bit_cast<std::uint64_t>(x)); }
    void add(std::integral auto x) { bits.push_back(static_cast<std::uint64_t>(x)); }
    template <class Three>
    requires requires(const Three& v) { v.x, v.y, v.z; }
    void add(const Three& v) { add(v.x), add(v.y), add(v.z); }
    void add(const Color& c) { add(c.r), add(c.g), add(c.b); }
    void add(const Box& box) { add(box.lower), add(box.upper); }
    void add(const Ray& ray) { add(ray.origin), add(ray.direction), add(ray.t_max); }
    void add(const Hit& hit) { add(hit.t), add(hit.u), add(hit.v), add(hit.normal), add(hit.position_error); }
    void add(const RayHit& hit) { add(hit.t), add(hit.u), add(hit.v), add(hit.primitive); }
    void add(const Surface& s) { add(s.position), add(s.position_error), add(s.normal), add(s.uv.u), add(s.dp_dv); }
    void add(const PointLocation& l) { add(l.winding_number), add(l.primitive); }
    void add(const ClosestPoint& p) { add(p.distance), add(p.position), add(p.u), add(p.primitive); }
    void add(const Image& image) {
        for (const float value : image.values()) add(std::bit_cast<std::uint32_t>(value));
    }
    template <class T>
    void add(const std::optional<T>& value) {
        if (value) add(*value);
    }
    template <class T>
    void add(const std::vector<T>& values) {
        for (const T& value : values) add(value);
    }
    template <class T>
    void add_bytes(const T& table) {
        for (const std::byte byte : std::as_bytes(std::span(table))) add(std::to_integer<int>(byte));
    }
};

constexpr RayFilter kBacks{.faces = Faces::back};

struct Entry {
    std::string name;
    std::function<void(Results&)> call;
};

// What the entries are called with, made in the default environment.
struct World {
    Random random{9020};
    std::vector<std::pair<std::string, Object>> shapes;
    Scene all, flat;  // all shapes; those of triangles, quads and disks alone, which have nearest points
    std::optional<CompiledScene> scene, flat_scene, tiny_scene;
    std::vector<Ray> rays, tiny_rays;
    std::vector<Point3> points, tiny_points;
    std::vector<Ray> hitting;  // rays of `hits`
    std::vector<RayHit> hits;
    std::vector<Surface> surfaces;
    Camera camera{.look_from = {.1, 1.7, 6.3}, .look_at = {.2, .1, .3}, .vertical_fov = 47};
    RenderSettings settings{.width = 24, .height = 16, .samples_per_pixel = 8, .threads = 2};
    std::optional<Film> film;

    World() {
        const auto material = std::make_shared<Lambertian>(Color{0.3, 0.6, 0.7});
        const Object mesh = std::make_shared<Mesh>(icosphere(2, 1.3, {0.1, 0.2, 0.3}), material);
        const Object round = std::make_shared<Sphere>(Point3{1.1, 0.3, -0.7}, Point3{1.3, 0.1, 0.2}, 0.9, material);
        shapes = {
            {"Sphere", round},
            {"Triangle", std::make_shared<Triangle>(Point3{-3, .1, .2}, Point3{3, .7, -2}, Point3{.3, 3, 2}, material)},
            {"Quad", std::make_shared<Quad>(Point3{-2.1, -2.2, .1}, Vec3{4, .3, .7}, Vec3{.1, 4, -.3}, material)},
            {"Disk", std::make_shared<Disk>(Point3{.3, -.7, .1}, Vec3{1, 2, 3}, 2.3, material)},
            {"Mesh", mesh},
            {"Instance", random_instance(random, mesh)},
            {"moving Instance",
             std::make_shared<Instance>(round, Transform::rotate({1, 2, 3}, 40), Transform::rotate({1, 2, 3}, 60))},
            {"HittableList", std::make_shared<HittableList>(std::vector<Object>{round, mesh})},
            {"Bvh", std::make_shared<Bvh>(std::vector<Object>{mesh, round})},
        };
        for (const auto& [name, shape] : shapes) all.add(shape);
        all.add(std::make_shared<ConstantMedium>(round, 0.5, Color{1, 1, 1}));
        all.add(std::make_shared<Mesh>(icosphere(5, 1.7, {-1, .3, .1}), material));
        for (const char* name : {"Triangle", "Quad", "Disk", "Mesh", "Instance"})
            flat.add(std::ranges::find(shapes, name, [](const auto& shape) { return shape.first; })->second);
        all.background = Background::gradient(Color{1, .9, .8}, Color{.5, .7, 1});
        scene = compile(all);
        flat_scene = compile(flat);
        // Decisions differ where all numbers are subnormal: a box, and a quad whose edges are open.
        Scene tiny;
        tiny.add(make_box({-kTiny, -kTiny, -kTiny}, {kTiny, kTiny, kTiny}, nullptr));
        tiny.add(std::make_shared<Quad>(Point3{-kTiny, -kTiny, 2 * kTiny}, Vec3{2 * kTiny, 0, 0}, Vec3{0, 2 * kTiny, 0},
                                        nullptr));
        tiny_scene = compile(tiny);
        for (int i = 0; i < 1100; ++i) {
            tiny_points.push_back(Point3{} + 2 * kTiny * random.in_cube(1));
            tiny_rays.push_back({.origin = tiny_points.back(), .direction = random.unit()});
        }
        for (int i = 0; i < 1100; ++i) {
            const Point3 from = Point3{} + random.in_cube(5);
            rays.push_back({.origin = from, .direction = Point3{} + random.in_cube(2) - from, .time = .3});
            points.push_back(Point3{} + random.in_cube(3));
        }
        for (const Ray& ray : rays)
            if (const auto hit = scene->closest_hit(ray)) {
                hitting.push_back(ray);
                hits.push_back(*hit);
                surfaces.push_back(scene->surface_at(ray, *hit));
            }
        RenderJob job(*scene, camera, settings);
        job.run();
        film = job.film();
    }
};

template <class Items, class Call>
std::function<void(Results&)> each(const Items& items, const Call& call) {
    return [&items, call](Results& r) {
        for (std::size_t i = 0; i < items.size(); ++i) r.add(call(i));
    };
}

// Bounds and hits of a shape that is made in the environment that is tried, along rays that pass near the origin.
std::function<void(Results&)> made(const std::vector<Ray>& rays, const std::function<Object()>& make) {
    return [&rays, make](Results& r) {
        const Object object = make();
        r.add(object->bounds());
        for (const Ray& ray : rays) r.add(object->hit(ray));
    };
}

// Construction decides exactly whether a shape is degenerate, at the smallest doubles and floats too.
void add_constructors(std::vector<Entry>& entries) {
    constexpr double kSide = 4 * kTiny;
    static const std::vector<Ray> rays{{.origin = {kTiny, kTiny, 4}, .direction = {0, 0, -1}},
                                       {.origin = {0.3, 0.3, 4}, .direction = {0, 0, -1}}};
    static const Object tiny = ball({0, 0, 0}, kSide);
    const auto add = [&](const char* name, const std::function<Object()>& make) {
        entries.push_back({name, made(rays, make)});
    };
    add("Triangle()", [] {
        return std::make_shared<Triangle>(Point3{}, Point3{kSide, 0, 0}, Point3{0, kSide, 0}, nullptr);
    });
    add("Quad()", [] { return std::make_shared<Quad>(Point3{}, Vec3{kSide, 0, 0}, Vec3{0, kSide, 0}, nullptr); });
    add("Mesh()", [] {
        MeshData data;
        data.vertices = {{0, 0, 0}, {0x1p-140f, 0, 0}, {0, 0x1p-140f, 0}};
        data.triangles = {{0, 1, 2}};
        return std::make_shared<Mesh>(data, nullptr);
    });
    add("Instance()", [] { return std::make_shared<Instance>(ball({0, 0, 0}, 1), Transform::scale(1, 1, 0x1p-1023)); });
    add("Bvh()", [] { return std::make_shared<Bvh>(std::vector<Object>{tiny, tiny}); });
    add("HittableList()", [] { return std::make_shared<HittableList>(std::vector<Object>{tiny, tiny}); });
    add("make_box", [] { return make_box({.1, .1, .1}, {1e3, 1e5 + .1, 1e7}, nullptr); });
}

void add_shapes(std::vector<Entry>& entries, const World& w) {
    for (const auto& named : w.shapes) {
        const Hittable* const shape = named.second.get();
        entries.push_back({named.first + "::bounds", [shape](Results& r) { r.add(shape->bounds()); }});
        entries.push_back(
            {named.first + "::hit", each(w.rays, [&w, shape](std::size_t i) { return shape->hit(w.rays[i]); })});
    }
    const std::vector<Surface>& s = w.surfaces;
    entries.push_back({"offset_origin", each(s, [&](std::size_t i) {
                           return offset_origin(s[i].position, s[i].position_error, s[i].normal, {1, 2, 3});
                       })});
    entries.push_back({"spawn_ray", each(s, [&](std::size_t i) { return s[i].spawn_ray({1, 2, 3}, 0); })});
    entries.push_back({"to a point", each(s, [&](std::size_t i) { return s[i].spawn_ray_to(Point3{1, 2, 3}, 0); })});
    entries.push_back({"to a surface", each(s, [&](std::size_t i) { return s[i].spawn_ray_to(s[i / 2], 0); })});
}

// Adds the queries of a scene, and those of the nearest points of a scene that has them.
void add_queries(std::vector<Entry>& entries, const CompiledScene& scene, const CompiledScene& flat,
                 const std::vector<Ray>& rays, const std::vector<Point3>& p) {
    const auto each_ray = [&](const char* name, const auto& call) {
        entries.push_back({name, each(rays, [&rays, call](std::size_t i) { return call(rays[i]); })});
    };
    for (const RayFilter* f : {&kNoFilter, &kBacks}) {
        each_ray("closest_hit", [&scene, f](const Ray& ray) { return scene.closest_hit(ray, *f); });
        each_ray("any_hit", [&scene, f](const Ray& ray) { return scene.any_hit(ray, *f); });
        each_ray("all_hits", [&scene, f](const Ray& ray) { return scene.all_hits(ray, *f); });
        each_ray("crossings", [&scene, f](const Ray& ray) { return scene.crossings(ray, *f); });
        each_ray("count_intersections", [&scene, f](const Ray& ray) { return scene.count_intersections(ray, *f); });
        each_ray("winding_number", [&scene, f](const Ray& ray) { return scene.winding_number(ray, *f); });
    }
    entries.push_back({"locate", each(p, [&](std::size_t i) { return scene.locate(p[i]); })});
    entries.push_back({"contains", each(p, [&](std::size_t i) { return scene.contains(p[i]); })});
    entries.push_back({"closest_point", each(p, [&](std::size_t i) { return flat.closest_point(p[i]); })});
    entries.push_back({"signed_distance", each(p, [&](std::size_t i) { return flat.signed_distance(p[i]); })});
    entries.push_back({"open_edges", [&](Results& r) { r.add(scene.open_edges()); }});
}

void add_surfaces(std::vector<Entry>& entries, const World& w) {
    const CompiledScene& scene = *w.scene;
    entries.push_back(
        {"surface_at", each(w.hits, [&](std::size_t i) { return scene.surface_at(w.hitting[i], w.hits[i]); })});
    entries.push_back({"albedo", each(w.surfaces, [&](std::size_t i) { return scene.albedo(w.surfaces[i]); })});
    entries.push_back({"outward_normals", [&](Results& r) {
                           std::vector<Vec3> normals(w.hits.size());
                           outward_normals(scene, w.hitting, w.hits, normals);
                           r.add(normals);
                       }});
}

// Adds a batch of queries, on one thread and on three, whose results have the type T.
template <class T, class Batch>
void add_batch(std::vector<Entry>& entries, const char* name, std::size_t count, const Batch& batch) {
    for (const int threads : {1, 3})
        entries.push_back({name + std::string(" in a batch"), [=](Results& r) {
                               std::vector<T> results(count);
                               batch(results, threads);
                               r.add(results);
                           }});
}

// Adds the batches of the same.
void add_batches(std::vector<Entry>& entries, const CompiledScene& scene, const CompiledScene& flat,
                 const std::vector<Ray>& rays, const std::vector<Point3>& points) {
    const std::size_t n = rays.size();
    for (const RayFilter* f : {&kNoFilter, &kBacks}) {
        add_batch<RayHit>(entries, "closest_hit", n, [&, f](auto& r, int t) { flat.closest_hit(rays, r, t, *f); });
        add_batch<std::uint8_t>(entries, "any_hit", n, [&, f](auto& r, int t) { flat.any_hit(rays, r, t, *f); });
        add_batch<std::uint64_t>(entries, "count_intersections", n,
                                 [&, f](auto& r, int t) { scene.count_intersections(rays, r, t, *f); });
        add_batch<RayHit>(entries, "all_hits", 0, [&, f](auto& r, int t) {
            RayHits hits;
            scene.all_hits(rays, hits, t, *f);
            r = hits.hits;
        });
    }
    add_batch<PointLocation>(entries, "locate", n, [&](auto& r, int t) { scene.locate(points, r, t); });
    add_batch<std::uint8_t>(entries, "contains", n, [&](auto& r, int t) { scene.contains(points, r, t); });
    add_batch<ClosestPoint>(entries, "closest_point", n, [&](auto& r, int t) { flat.closest_point(points, r, t); });
    add_batch<double>(entries, "signed_distance", n, [&](auto& r, int t) { flat.signed_distance(points, r, t); });
}

void add_tables(Results& r, const CompiledScene& scene) {
    r.add_bytes(scene.flat().nodes);
    r.add_bytes(scene.flat().lines);
}

// The threads of an arena take over the environment in which it is made.
void add_scenes_and_pictures(std::vector<Entry>& entries, const World& w) {
    entries.push_back(
        {"compile", [&](Results& r) { tbb::task_arena(4).execute([&] { add_tables(r, compile(w.all)); }); }});
    entries.push_back({"recompile", [&](Results& r) {
                           const std::vector<MovedObject> moved{{5, Transform::rotate({3, 1, 2}, 70)}};
                           tbb::task_arena(4).execute([&] { add_tables(r, recompile(compile(w.all), moved)); });
                       }});
    entries.push_back({"render", [&](Results& r) { r.add(render(*w.scene, w.camera, w.settings).image); }});
    entries.push_back({"first_hits", [&](Results& r) {
                           const FirstHits hits = first_hits(*w.scene, w.camera, w.settings);
                           r.add(hits.albedo), r.add(hits.normal), r.add(hits.position);
                       }});
    entries.push_back({"render_result", [&](Results& r) {
                           const RenderResult result = render_result(*w.film);
                           r.add(result.image), r.add(result.error.estimate);
                       }});
}

Results in_environment(unsigned csr, const Entry& entry, bool& is_kept) {
    Results results;
    const InEnvironment there(csr);
    try {
        entry.call(results);
    } catch (const Error&) {
        results.add(-1);
    }
    is_kept = there.is_as_it_was();
    return results;
}

}  // namespace

TEST_CASE("Entries: in every floating-point environment the bits of the default one, and it is left as it was",
          "[hard][environment]") {
    const World world;
    REQUIRE(world.hits.size() > 500);
    std::vector<Entry> entries;
    add_constructors(entries);
    add_shapes(entries, world);
    add_surfaces(entries, world);
    for (const auto& add : {add_queries, add_batches}) {
        add(entries, *world.scene, *world.flat_scene, world.rays, world.points);
        add(entries, *world.tiny_scene, *world.tiny_scene, world.tiny_rays, world.tiny_points);
    }
    add_scenes_and_pictures(entries, world);
    for (const Entry& entry : entries) {
        bool is_kept = false;
        const Results expected = in_environment(kDefault, entry, is_kept);
        CHECK(expected.bits.size() > 0);
        for (const Environment& environment : kEnvironments) {
            INFO(entry.name << ", " << environment.name);
            CHECK((in_environment(environment.csr, entry, is_kept).bits == expected.bits));
            CHECK(is_kept);
        }
    }
}

}  // namespace limn::entries_test

#endif
