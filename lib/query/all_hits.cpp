// Implements CompiledScene::all_hits, for one ray and for batches.
#include <algorithm>
#include <vector>

#include "limn/query/compiled_scene.h"
#include "query/batches.h"
#include "query/results.h"

namespace limn {

namespace {

// Appends the hits of one ray to `hits`. \pre is_usable(ray)
void append_hits(const flat::Scene& scene, const Ray& ray, const query::Excluded& excluded, std::vector<RayHit>& hits) {
    query::Found found;
    std::vector<trace::Crossing>& crossings = *found;
    trace::every_hit(scene, ray, crossings, excluded);
    query::sort_along_ray(crossings);
    // The two hits of a sphere that the ray only touches have the same t.
    const auto same = [](const trace::Crossing& a, const trace::Crossing& b) {
        return a.t == b.t && a.primitive == b.primitive;
    };
    crossings.erase(std::unique(crossings.begin(), crossings.end(), same), crossings.end());
    const std::size_t before = hits.size();
    hits.resize(before + crossings.size());
    for (std::size_t i = 0; i < crossings.size(); ++i) hits[before + i] = query::complete(scene, crossings[i]);
}

}  // namespace

std::vector<RayHit> CompiledScene::all_hits(const Ray& ray, const RayFilter& filter) const {
    return query::ask(*this, ray, filter, "all_hits", [](const auto& scene, const auto& usable, const auto& excluded) {
        std::vector<RayHit> hits;
        append_hits(scene, usable, excluded, hits);
        return hits;
    });
}

std::size_t CompiledScene::all_hits(std::span<const Ray> rays, RayHits& hits, int threads,
                                    const RayFilter& filter) const {
    // Collect the hits of each part of the batch, and store the number of hits of ray i in hits.first[i + 1].
    const std::size_t part = query::part_size(rays.size(), threads);
    std::vector<std::vector<RayHit>> parts((rays.size() + part - 1) / part);
    hits.first.assign(rays.size() + 1, 0);
    const std::span numbers = std::span(hits.first).subspan(1);
    const auto collect = [&](std::size_t i, const query::Excluded& excluded) {
        std::vector<RayHit>& here = parts[i / part];
        const std::size_t before = here.size();
        append_hits(flat(), rays[i], excluded, here);
        return here.size() - before;
    };
    const std::size_t unusable = query::answer_rays(flat(), rays, numbers, threads, filter, "all_hits", collect);
    // Sum up the numbers of hits, and concatenate the hits of all parts.
    for (std::size_t i = 0; i < rays.size(); ++i) hits.first[i + 1] += hits.first[i];
    hits.hits.clear();
    hits.hits.reserve(hits.first.back());
    for (const std::vector<RayHit>& here : parts) hits.hits.insert(hits.hits.end(), here.begin(), here.end());
    return unusable;
}

}  // namespace limn
