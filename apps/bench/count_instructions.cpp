// performance.py counts the instructions of the functions measure_* under callgrind. Each is called once. They trace
// rays of a mesh scene, and render it before a background and under lamps. Without callgrind: their times, as JSON on
// stdout, nanoseconds a ray.
//
// limn_count_instructions [--rays N] [--rounds N] [--user-defined]
//   --rays N     of each kind
//   --rounds N   calls of each function: their times are then printed, round by round
//   --user-defined    a user-defined sphere is beside the mesh, in place of a triangle; no ray that is traced meets its
//                box
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>

#include "bench/rays.h"
#include "bench/scenes.h"
#include "bench/stopwatch.h"
#include "limn/material/diffuse_light.h"
#include "limn/material/lambertian.h"
#include "limn/render/render.h"
#include "limn/shape/quad.h"
#include "limn/shape/sphere.h"

namespace {

using namespace limn;

// limn knows it by its virtual functions alone.
class UserDefinedSphere final : public Hittable {
public:
    UserDefinedSphere(const Point3& center, double radius) : sphere_(center, radius, nullptr) {}
    Box bounds() const override { return sphere_.bounds(); }
    std::optional<Hit> hit(const Ray& ray) const override { return sphere_.hit(ray); }

private:
    Sphere sphere_;
};

struct Work {
    CompiledScene scene, under_lamps;
    std::vector<Ray> primary, diffuse, shadow;
    Camera camera;
    std::vector<RayHit> hits;
    std::vector<std::uint8_t> occluded;
};

void trace_single(Work& work, const std::vector<Ray>& rays) {
    for (std::size_t i = 0; i < rays.size(); ++i) work.hits[i] = work.scene.closest_hit(rays[i]).value_or(RayHit{});
}
void trace_batch(Work& work, const std::vector<Ray>& rays) {
    work.scene.closest_hit(rays, std::span(work.hits).first(rays.size()));
}
std::uint64_t render_small(const CompiledScene& scene, const Camera& camera) {
    return render(scene, camera, {.width = 32, .height = 32, .samples_per_pixel = 4, .max_depth = 4, .threads = 1})
        .report.rays;
}

}  // namespace

// Outside of any namespace and not inlined, so that callgrind knows them by these names.
extern "C" {
[[gnu::noinline]] void measure_primary_single(Work& work) { trace_single(work, work.primary); }
[[gnu::noinline]] void measure_primary_batch(Work& work) { trace_batch(work, work.primary); }
[[gnu::noinline]] void measure_diffuse_single(Work& work) { trace_single(work, work.diffuse); }
[[gnu::noinline]] void measure_diffuse_batch(Work& work) { trace_batch(work, work.diffuse); }
[[gnu::noinline]] void measure_shadow_single(Work& work) {
    for (std::size_t i = 0; i < work.shadow.size(); ++i) work.occluded[i] = work.scene.any_hit(work.shadow[i]) ? 1 : 0;
}
[[gnu::noinline]] void measure_shadow_batch(Work& work) {
    work.scene.any_hit(work.shadow, std::span(work.occluded).first(work.shadow.size()));
}
[[gnu::noinline]] std::uint64_t measure_render(Work& work) { return render_small(work.scene, work.camera); }
[[gnu::noinline]] std::uint64_t measure_lamps(Work& work) { return render_small(work.under_lamps, work.camera); }
}

namespace {

// The rays that do not meet the box.
std::vector<Ray> that_miss(const std::vector<Ray>& rays, const Box& box) {
    std::vector<Ray> kept;
    for (const Ray& ray : rays) {
        double enter = ray.t_min, leave = ray.t_max;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double a = (box.lower[axis] - ray.origin[axis]) / ray.direction[axis];
            const double b = (box.upper[axis] - ray.origin[axis]) / ray.direction[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        if (!(enter <= leave)) kept.push_back(ray);
    }
    return kept;
}

// A panel and a ball in place of a background: lights of two kinds, between which each vertex chooses.
Scene under_lamps(const std::shared_ptr<const Hittable>& object) {
    const auto lamp = std::make_shared<DiffuseLight>(Color{5, 5, 5});
    Scene scene;
    scene.add(object);
    scene.add(std::make_shared<Quad>(Point3{-1, 3, -1}, Vec3{2, 0, 0}, Vec3{0, 0, 2}, lamp));
    scene.add(std::make_shared<Sphere>(Point3{3, 1, 1}, 0.5, lamp));
    return scene;
}

Work prepare(std::size_t rays, bool with_user_defined) {
    const bench::Geometry geometry = bench::make_scene("sphere", 0.01);
    // The mesh again, with a material to be rendered with.
    const auto mesh = std::make_shared<Mesh>(geometry.mesh->data(), std::make_shared<Lambertian>(Color{.5, .5, .5}));
    Scene scene;
    scene.background = Background::constant({1, 1, 1});
    scene.add(mesh);
    Scene with_sphere = scene;
    const auto aside = std::make_shared<UserDefinedSphere>(Point3{1.5, 1.5, 0}, 0.3);
    with_sphere.add(aside);
    // In its place one triangle of another mesh, so that both scenes have two objects.
    MeshData corner;
    corner.vertices = {{1.2f, 1.2f, -0.3f}, {1.8f, 1.2f, 0.3f}, {1.5f, 1.8f, 0}};
    corner.triangles = {{0, 1, 2}};
    scene.add(std::make_shared<Mesh>(std::move(corner), std::make_shared<Lambertian>(Color{.5, .5, .5})));
    Camera camera = frame_box(mesh->bounds());
    Work work{compile(scene), compile(under_lamps(mesh)), {}, {}, {}, camera, {}, {}};
    for (const bench::RaySet& set : bench::make_rays(geometry, work.scene, rays)) {
        std::vector<Ray> kept = that_miss(set.rays, aside->bounds());
        if (set.name == "primary") work.primary = std::move(kept);
        if (set.name == "diffuse1") work.diffuse = std::move(kept);
        if (set.name == "shadow") work.shadow = std::move(kept);
    }
    if (with_user_defined) work.scene = compile(with_sphere);
    work.hits.resize(std::max(work.primary.size(), work.diffuse.size()));
    work.occluded.resize(work.shadow.size());
    return work;
}

using Times = std::map<std::string, std::vector<double>>;

template <class Measure>
void time(Times& times, const char* name, std::size_t rays, const Measure& measure) {
    const bench::Stopwatch watch(bench::Clock::thread);  // all that is measured runs in this one
    measure();
    times[name].push_back(1e9 * watch.seconds() / static_cast<double>(rays));
}

std::size_t number_after(int argc, char** argv, const char* option, std::size_t otherwise) {
    for (int i = 1; i + 1 < argc; ++i)
        if (std::strcmp(argv[i], option) == 0) return static_cast<std::size_t>(std::atoll(argv[i + 1]));
    return otherwise;
}

}  // namespace

int main(int argc, char** argv) {
    const bool with_user_defined =
        std::any_of(argv + 1, argv + argc, [](const char* word) { return std::strcmp(word, "--user-defined") == 0; });
    Work work = prepare(number_after(argc, argv, "--rays", 2000), with_user_defined);
    const std::size_t rounds = number_after(argc, argv, "--rounds", 1);
    Times times;
    std::uint64_t rendered = 0, rendered_under_lamps = 0;
    for (std::size_t round = 0; round < rounds; ++round) {
        time(times, "primary_single", work.primary.size(), [&] { measure_primary_single(work); });
        time(times, "primary_batch", work.primary.size(), [&] { measure_primary_batch(work); });
        time(times, "diffuse_single", work.diffuse.size(), [&] { measure_diffuse_single(work); });
        time(times, "diffuse_batch", work.diffuse.size(), [&] { measure_diffuse_batch(work); });
        time(times, "shadow_single", work.shadow.size(), [&] { measure_shadow_single(work); });
        time(times, "shadow_batch", work.shadow.size(), [&] { measure_shadow_batch(work); });
        if (with_user_defined) continue;  // the sphere would be seen there
        time(times, "render", 1, [&] { rendered = measure_render(work); });
        time(times, "lamps", 1, [&] { rendered_under_lamps = measure_lamps(work); });
    }
    std::printf("{\"rays\": {\"primary\": %zu, \"diffuse\": %zu, \"shadow\": %zu, \"render\": %llu, \"lamps\": %llu}",
                work.primary.size(), work.diffuse.size(), work.shadow.size(), static_cast<unsigned long long>(rendered),
                static_cast<unsigned long long>(rendered_under_lamps));
    for (const auto& [name, list] : times) {
        std::printf(", \"%s\": [", name.c_str());
        for (std::size_t i = 0; i < list.size(); ++i) std::printf("%s%g", i > 0 ? ", " : "", list[i]);
        std::printf("]");
    }
    std::printf("}\n");
}
