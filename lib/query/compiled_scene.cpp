#include "limn/query/compiled_scene.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "flat/compile.h"
#include "math/float_environment.h"
#include "query/filters.h"
#include "query/results.h"
#include "query/surface_at.h"
#include "query/threads.h"
#include "shading/albedo.h"
#include "shading/shading.h"
#include "trace/traverse.h"

namespace limn {

using query::complete, query::is_fit;

namespace {

// The two functions below handle the boundaries of media, which trace::closest_hit and any_hit leave out. They aren't
// inlined, so that a scene without media pays only for one comparison.

// Replaces `best` if the ray hits the boundary of a medium before it. Of hits at the same t, the one of the primitive
// with the lowest number is kept.
[[gnu::noinline]] void nearer_boundary(const flat::Scene& scene, const Ray& ray, trace::Hit& best) {
    for (const flat::Medium& medium : scene.media) {
        Ray rest = ray;
        rest.t_max = std::min(ray.t_max, best.t);
        trace::Hit hit = trace::closest_boundary(scene, medium, rest);
        hit.index_matched = true;
        if (hit.t < best.t || (hit.t == best.t && hit.primitive < best.primitive)) best = hit;
    }
}

// Returns true if the ray hits the boundary of any medium.
[[gnu::noinline]] bool meets_boundary(const flat::Scene& scene, const Ray& ray) {
    return std::ranges::any_of(scene.media, [&](const flat::Medium& medium) {
        return trace::closest_boundary(scene, medium, ray).primitive != flat::RawHit::kMiss;
    });
}

// Returns the closest hit of one ray, boundaries of media included. The attribute makes the compiler inline it although
// it has two callers. \pre is_usable(ray)
[[gnu::always_inline]] inline std::optional<RayHit> find_closest(const flat::Scene& scene, const Ray& ray) {
    trace::Hit hit = trace::closest_hit(scene, ray);
    if (!scene.media.empty()) nearer_boundary(scene, ray, hit);
    if (hit.primitive == flat::RawHit::kMiss) return std::nullopt;
    return complete(scene, hit);
}

// Returns true if the ray has any hit, boundaries of media included. \pre is_usable(ray)
bool find_any(const flat::Scene& scene, const Ray& ray) {
    return trace::any_hit(scene, ray) || (!scene.media.empty() && meets_boundary(scene, ray));
}

// Calls work(first, count) for each run of consecutive usable rays, of at most trace::kMostRays rays. Calls refuse(i)
// for each unusable ray i. Returns the number of unusable rays.
template <class Work, class Refuse>
std::size_t for_each_run(std::span<const Ray> rays, const Work& work, const Refuse& refuse) {
    const FloatEnvironment environment;
    std::size_t unusable = 0;
    for (std::size_t first = 0, end = 0; first < rays.size(); first = end) {
        while (end < rays.size() && end - first < trace::kMostRays && is_fit(rays[end])) ++end;
        if (end > first) work(first, end - first);
        if (end < rays.size() && !is_fit(rays[end])) {
            refuse(end++);
            ++unusable;
        }
    }
    return unusable;
}

// Finds the closest hit of each ray of a batch. Returns the number of unusable rays.
std::size_t find_closest(const flat::Scene& scene, std::span<const Ray> rays, std::span<RayHit> hits) {
    const auto refuse = [&](std::size_t i) { hits[i] = {}; };
    // In a scene with media, trace the rays one by one.
    if (!scene.media.empty())
        return for_each_run(
            rays,
            [&](std::size_t first, std::size_t count) {
                for (std::size_t i = first; i < first + count; ++i)
                    hits[i] = find_closest(scene, rays[i]).value_or(RayHit{});
            },
            refuse);
    // Otherwise, trace runs of rays together.
    std::array<trace::Hit, trace::kMostRays> found;
    return for_each_run(
        rays,
        [&](std::size_t first, std::size_t count) {
            trace::closest_hits(scene, rays.subspan(first, count), found.data());
            for (std::size_t i = 0; i < count; ++i)
                hits[first + i] = found[i].primitive == flat::RawHit::kMiss ? RayHit{} : complete(scene, found[i]);
        },
        refuse);
}

// Sets occluded[i] to 1 if ray i of a batch has any hit, else to 0. Returns the number of unusable rays.
std::size_t find_any(const flat::Scene& scene, std::span<const Ray> rays, std::span<std::uint8_t> occluded) {
    return for_each_run(
        rays,
        [&](std::size_t first, std::size_t count) {
            if (scene.media.empty()) return trace::any_hits(scene, rays.subspan(first, count), &occluded[first]);
            for (std::size_t i = first; i < first + count; ++i) occluded[i] = find_any(scene, rays[i]) ? 1 : 0;
        },
        [&](std::size_t i) { occluded[i] = 0; });
}

SceneStats stats_of(const flat::Scene& s) {
    return {.memory_bytes = s.memory_bytes,
            .primitives = s.primitives,
            .stored_primitives = s.stored_primitives,
            .degenerate = s.degenerate,
            .lights = s.lights.size() + s.lights.distant.size(),
            .seconds = s.compile_seconds};
}

}  // namespace

CompiledScene::CompiledScene(std::unique_ptr<flat::Scene> scene)
    : scene_(std::move(scene)), stats_(stats_of(*scene_)) {}
CompiledScene::CompiledScene(CompiledScene&&) noexcept = default;
CompiledScene& CompiledScene::operator=(CompiledScene&&) noexcept = default;
CompiledScene::~CompiledScene() = default;

std::optional<RayHit> CompiledScene::closest_hit(const Ray& ray) const {
    const FloatEnvironment environment;
    return is_fit(ray) ? find_closest(*scene_, ray) : std::nullopt;
}

bool CompiledScene::any_hit(const Ray& ray) const {
    const FloatEnvironment environment;
    return is_fit(ray) && find_any(*scene_, ray);
}

std::size_t CompiledScene::closest_hit(std::span<const Ray> rays, std::span<RayHit> hits, int threads) const {
    query::check_length(rays.size(), hits.size(), "closest_hit: rays and hits differ in length");
    std::atomic<std::size_t> unusable = 0;
    query::for_all_parts(rays.size(), threads, "closest_hit", [&](std::size_t first, std::size_t count) {
        unusable += find_closest(*scene_, rays.subspan(first, count), hits.subspan(first, count));
    });
    return unusable;
}

std::size_t CompiledScene::any_hit(std::span<const Ray> rays, std::span<std::uint8_t> occluded, int threads) const {
    query::check_length(rays.size(), occluded.size(), "any_hit: rays and occluded differ in length");
    std::atomic<std::size_t> unusable = 0;
    query::for_all_parts(rays.size(), threads, "any_hit", [&](std::size_t first, std::size_t count) {
        unusable += find_any(*scene_, rays.subspan(first, count), occluded.subspan(first, count));
    });
    return unusable;
}

std::optional<RayHit> CompiledScene::closest_hit(const Ray& ray, const RayFilter& filter) const {
    const FloatEnvironment environment;
    const trace::Filter checked = query::checked(*scene_, filter, "closest_hit");
    if (!is_fit(ray)) return std::nullopt;
    const trace::Hit hit = trace::closest_hit(*scene_, ray, checked);
    if (hit.primitive == flat::RawHit::kMiss) return std::nullopt;
    return complete(*scene_, hit);
}

bool CompiledScene::any_hit(const Ray& ray, const RayFilter& filter) const {
    const FloatEnvironment environment;
    const trace::Filter checked = query::checked(*scene_, filter, "any_hit");
    return is_fit(ray) && trace::any_hit(*scene_, ray, checked);
}

Surface CompiledScene::surface_at(const Ray& ray, const RayHit& hit) const {
    const FloatEnvironment environment;
    return query::surface_at(*scene_, ray, {{hit.t, hit.primitive}, hit.u, hit.v}).surface;
}

Color CompiledScene::albedo(const Surface& surface) const {
    const FloatEnvironment environment;
    return shade::albedo(*scene_, surface);
}

Color CompiledScene::emission(const Surface& surface) const {
    const FloatEnvironment environment;
    return shade::can_emit(*scene_, surface.material) ? shade::emitted(*scene_, surface) : Color{};
}

std::string_view CompiledScene::material_name(const RayHit& hit) const {
    const auto& names = scene_->material_names[hit.object];
    const flat::Place place = flat::locate(*scene_, hit.primitive);
    const PrimitiveRange& range = scene_->ranges[place.range];
    if (!names || range.kind != PrimitiveKind::mesh) return {};
    const std::span slots = scene_->meshes[range.first_row].arrays.material_slots;
    const std::size_t slot = slots.empty() ? 0 : slots[place.element];
    return slot == 0 || slot > names->size() ? std::string_view{} : (*names)[slot - 1];
}

const std::string& CompiledScene::features() const { return scene_->feature_names; }
const std::string& CompiledScene::name() const { return scene_->name; }
const Hash128& CompiledScene::digest() const { return scene_->digest; }
bool CompiledScene::has_untagged() const { return scene_->untagged; }

CompiledScene compile(const Scene& scene) {
    const FloatEnvironment environment;
    return CompiledScene(std::make_unique<flat::Scene>(compiler::flatten(scene)));
}

CompiledScene recompile(CompiledScene&& scene, std::span<const MovedObject> moved) {
    const FloatEnvironment environment;
    compiler::move(*scene.scene_, moved);
    return CompiledScene(std::move(scene.scene_));
}

}  // namespace limn
