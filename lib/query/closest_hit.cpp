// Implements CompiledScene::closest_hit and any_hit, for one ray and for batches.
#include <algorithm>
#include <array>

#include "limn/query/compiled_scene.h"
#include "query/batches.h"
#include "query/results.h"

namespace limn {

using query::ask, query::complete, query::Excluded, query::is_fit;

namespace {

// The two functions below handle the boundaries of media, which a search without a filter leaves out. They aren't
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

// Returns the closest hit of one ray, boundaries of media included. \pre is_usable(ray)
[[gnu::always_inline]] inline std::optional<RayHit> find_closest(const flat::Scene& scene, const Ray& ray,
                                                                 const Excluded& excluded) {
    trace::Hit hit = excluded ? trace::closest_hit(scene, ray, *excluded) : trace::closest_hit(scene, ray);
    if (!excluded && !scene.media.empty()) nearer_boundary(scene, ray, hit);
    if (hit.primitive == flat::RawHit::kMiss) return std::nullopt;
    return complete(scene, hit);
}

// Returns true if the ray has any hit, boundaries of media included. \pre is_usable(ray)
[[gnu::always_inline]] inline bool find_any(const flat::Scene& scene, const Ray& ray, const Excluded& excluded) {
    if (excluded) return trace::any_hit(scene, ray, *excluded);
    return trace::any_hit(scene, ray) || (!scene.media.empty() && meets_boundary(scene, ray));
}

// Calls work(first, count) for each run of consecutive usable rays from `begin` to `end`, of at most trace::kMostRays
// rays. Calls refuse(i) for each unusable ray i. Returns the number of unusable rays.
template <class Work, class Refuse>
std::size_t for_each_run(std::span<const Ray> rays, std::size_t begin, std::size_t end, const Work& work,
                         const Refuse& refuse) {
    std::size_t unusable = 0;
    for (std::size_t first = begin, last = begin; first < end; first = last) {
        while (last < end && last - first < trace::kMostRays && is_fit(rays[last])) ++last;
        if (last > first) work(first, last - first);
        if (last < end && !is_fit(rays[last])) {
            refuse(last++);
            ++unusable;
        }
    }
    return unusable;
}

// Returns true if the rays of a batch can be traced together. Otherwise they are traced one by one.
bool can_trace_together(const flat::Scene& scene, const RayFilter& filter) {
    return scene.media.empty() && filter.is_empty();
}

}  // namespace

std::optional<RayHit> CompiledScene::closest_hit(const Ray& ray, const RayFilter& filter) const {
    return ask(*this, ray, filter, "closest_hit", [](const auto&... query) { return find_closest(query...); });
}

bool CompiledScene::any_hit(const Ray& ray, const RayFilter& filter) const {
    return ask(*this, ray, filter, "any_hit", [](const auto&... query) { return find_any(query...); });
}

std::size_t CompiledScene::closest_hit(std::span<const Ray> rays, std::span<RayHit> hits, int threads,
                                       const RayFilter& filter) const {
    constexpr const char* kWho = "closest_hit";
    query::check_length(rays.size(), hits.size(), "closest_hit: rays and hits differ in length");
    const flat::Scene& scene = flat();
    const auto refuse = [&](std::size_t i) { hits[i] = {}; };
    if (!can_trace_together(scene, filter))
        return query::for_each_ray(
            scene, rays, filter, threads, kWho,
            [&](std::size_t i, const Excluded& excluded) {
                hits[i] = find_closest(scene, rays[i], excluded).value_or(RayHit{});
            },
            refuse);
    std::atomic<std::size_t> unusable = 0;
    query::for_all_parts(rays.size(), threads, kWho, [&](std::size_t begin, std::size_t size) {
        std::array<trace::Hit, trace::kMostRays> found;
        const auto trace_run = [&](std::size_t first, std::size_t count) {
            trace::closest_hits(scene, rays.subspan(first, count), found.data());
            for (std::size_t i = 0; i < count; ++i)
                hits[first + i] = found[i].primitive == flat::RawHit::kMiss ? RayHit{} : complete(scene, found[i]);
        };
        unusable += for_each_run(rays, begin, begin + size, trace_run, refuse);
    });
    return unusable;
}

std::size_t CompiledScene::any_hit(std::span<const Ray> rays, std::span<std::uint8_t> occluded, int threads,
                                   const RayFilter& filter) const {
    constexpr const char* kWho = "any_hit";
    query::check_length(rays.size(), occluded.size(), "any_hit: rays and occluded differ in length");
    const flat::Scene& scene = flat();
    const auto refuse = [&](std::size_t i) { occluded[i] = 0; };
    if (!can_trace_together(scene, filter))
        return query::for_each_ray(
            scene, rays, filter, threads, kWho,
            [&](std::size_t i, const Excluded& excluded) { occluded[i] = find_any(scene, rays[i], excluded) ? 1 : 0; },
            refuse);
    std::atomic<std::size_t> unusable = 0;
    query::for_all_parts(rays.size(), threads, kWho, [&](std::size_t begin, std::size_t size) {
        const auto trace_run = [&](std::size_t first, std::size_t count) {
            trace::any_hits(scene, rays.subspan(first, count), &occluded[first]);
        };
        unusable += for_each_run(rays, begin, begin + size, trace_run, refuse);
    });
    return unusable;
}

}  // namespace limn
