// Implements CompiledScene::closest_hit and any_hit, for one ray and for batches.
#include <algorithm>

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

// Sets results[i] to answer(scene, rays[i], filter) for each usable ray of a batch, and to a default-constructed result
// for each unusable one. Rays are traced together, by Together, unless there are media or a filter. Returns the number
// of unusable rays. \throws ArgumentError as answer_rays() does
template <class Together, class Result, class Answer>
std::size_t answer_together(const flat::Scene& scene, std::span<const Ray> rays, std::span<Result> results, int threads,
                            const RayFilter& filter, const char* who, const Answer& answer) {
    if (!scene.media.empty() || !filter.is_empty())
        return query::answer_rays(
            scene, rays, results, threads, filter, who,
            [&](std::size_t i, const Excluded& excluded) { return answer(scene, rays[i], excluded); });
    std::atomic<std::size_t> unusable = 0;
    query::for_all_parts(rays.size(), threads, who, [&](std::size_t begin, std::size_t size) {
        Together together;
        const std::size_t end = begin + size;
        for (std::size_t first = begin, last = begin; first < end; first = last) {
            // Trace a run of usable rays.
            while (last < end && last - first < trace::kMostRays && is_fit(rays[last])) ++last;
            if (last > first) together(scene, rays.subspan(first, last - first), &results[first]);
            // Pass the unusable ray that ends it.
            if (last == end || is_fit(rays[last])) continue;
            results[last++] = {};
            ++unusable;
        }
    });
    return unusable;
}

// Find the closest hits of usable rays, and whether they have any hit.
struct ClosestTogether {
    trace::RoomForRays<trace::Hit> found;

    void operator()(const flat::Scene& scene, std::span<const Ray> rays, RayHit* hits) {
        trace::closest_hits(scene, rays, found.of.data());
        for (std::size_t i = 0; i < rays.size(); ++i)
            hits[i] = found.of[i].primitive == flat::RawHit::kMiss ? RayHit{} : complete(scene, found.of[i]);
    }
};
struct AnyTogether {
    void operator()(const flat::Scene& scene, std::span<const Ray> rays, std::uint8_t* occluded) const {
        trace::any_hits(scene, rays, occluded);
    }
};

}  // namespace

std::optional<RayHit> CompiledScene::closest_hit(const Ray& ray, const RayFilter& filter) const {
    return ask(*this, ray, filter, "closest_hit", [](const auto&... query) { return find_closest(query...); });
}

bool CompiledScene::any_hit(const Ray& ray, const RayFilter& filter) const {
    return ask(*this, ray, filter, "any_hit", [](const auto&... query) { return find_any(query...); });
}

std::size_t CompiledScene::closest_hit(std::span<const Ray> rays, std::span<RayHit> hits, int threads,
                                       const RayFilter& filter) const {
    query::check_length(rays.size(), hits.size(), "closest_hit", "rays and hits");
    const auto answer = [](const auto&... query) { return find_closest(query...).value_or(RayHit{}); };
    return answer_together<ClosestTogether>(flat(), rays, hits, threads, filter, "closest_hit", answer);
}

std::size_t CompiledScene::any_hit(std::span<const Ray> rays, std::span<std::uint8_t> occluded, int threads,
                                   const RayFilter& filter) const {
    query::check_length(rays.size(), occluded.size(), "any_hit", "rays and occluded");
    const auto answer = [](const auto&... query) { return find_any(query...) ? 1 : 0; };
    return answer_together<AnyTogether>(flat(), rays, occluded, threads, filter, "any_hit", answer);
}

}  // namespace limn
