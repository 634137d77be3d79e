// Implements the forms of CompiledScene::all_hits for one ray.
#include <algorithm>
#include <vector>

#include "limn/query/compiled_scene.h"
#include "math/float_environment.h"
#include "query/filters.h"
#include "query/results.h"

namespace limn {

namespace {

// Sorts `found` along the ray, removes duplicates from it, and appends it to `hits`.
void list(const flat::Scene& scene, std::vector<trace::Crossing>& found, std::vector<RayHit>& hits) {
    query::sort_along_ray(found);
    // The two hits of a sphere that the ray only touches have the same t.
    const auto same = [](const trace::Crossing& a, const trace::Crossing& b) {
        return a.t == b.t && a.primitive == b.primitive;
    };
    found.erase(std::unique(found.begin(), found.end(), same), found.end());
    hits.reserve(found.size());
    for (const trace::Crossing& c : found) hits.push_back(query::complete(scene, c));
}

}  // namespace

void CompiledScene::all_hits(const Ray& ray, std::vector<RayHit>& hits) const {
    const FloatEnvironment environment;
    hits.clear();
    if (!query::is_fit(ray)) return;
    query::Found found;
    trace::every_hit(*scene_, ray, *found);
    list(*scene_, *found, hits);
}

std::vector<RayHit> CompiledScene::all_hits(const Ray& ray) const {
    std::vector<RayHit> hits;
    all_hits(ray, hits);
    return hits;
}

void CompiledScene::all_hits(const Ray& ray, const RayFilter& filter, std::vector<RayHit>& hits) const {
    const FloatEnvironment environment;
    const trace::Filter checked = query::checked(*scene_, filter, "all_hits");
    hits.clear();
    if (!query::is_fit(ray)) return;
    query::Found found;
    trace::every_hit(*scene_, ray, checked, *found);
    list(*scene_, *found, hits);
}

}  // namespace limn
