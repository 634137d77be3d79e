// Implements CompiledScene::crossings, count_intersections and winding_number. They follow from the passages of a ray
// through surfaces (geometry/passage.h).
#include <vector>

#include "limn/query/compiled_scene.h"
#include "query/batches.h"
#include "query/results.h"

namespace limn {

namespace {

// Counts the passages of a ray. \pre is_usable(ray)
constexpr auto count = [](const flat::Scene& scene, const Ray& ray, const query::Excluded& excluded) {
    return trace::passages(scene, ray, false, nullptr, excluded);
};

}  // namespace

std::vector<RayCrossing> CompiledScene::crossings(const Ray& ray, const RayFilter& filter) const {
    return query::ask(*this, ray, filter, "crossings", [](const auto& scene, const auto& usable, const auto& excluded) {
        query::Found found;
        trace::passages(scene, usable, false, &*found, excluded);
        query::sort_along_ray(*found);
        std::vector<RayCrossing> crossings;
        crossings.reserve((*found).size());
        for (const trace::Crossing& c : *found) crossings.push_back({query::complete(scene, c), c.inward});
        return crossings;
    });
}

std::size_t CompiledScene::count_intersections(const Ray& ray, const RayFilter& filter) const {
    return query::ask(*this, ray, filter, "count_intersections",
                      [](const auto&... query) { return count(query...).count; });
}

std::int64_t CompiledScene::winding_number(const Ray& ray, const RayFilter& filter) const {
    return query::ask(*this, ray, filter, "winding_number",
                      [](const auto&... query) { return count(query...).outward; });
}

std::size_t CompiledScene::count_intersections(std::span<const Ray> rays, std::span<std::uint64_t> counts, int threads,
                                               const RayFilter& filter) const {
    constexpr const char* kWho = "count_intersections";
    query::check_length(rays.size(), counts.size(), kWho, "rays and counts");
    const auto answer = [&](std::size_t i, const auto& excluded) { return count(flat(), rays[i], excluded).count; };
    return query::answer_rays(flat(), rays, counts, threads, filter, kWho, answer);
}

}  // namespace limn
