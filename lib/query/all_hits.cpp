// Every hit along a ray.
#include <algorithm>
#include <vector>

#include "core/float_environment.h"
#include "limn/query/compiled_scene.h"
#include "query/answers.h"

namespace limn {

namespace {

// Of a thread, so that a ray costs no allocation.
std::vector<trace::Crossing>& scratch() {
    thread_local std::vector<trace::Crossing> hits;
    hits.clear();
    return hits;
}

void find_all(const flat::Scene& scene, const Ray& ray, std::vector<trace::Crossing>& found) {
    trace::every_hit(scene, ray, found);
    for (const flat::Medium& medium : scene.media) {
        const std::size_t before = found.size();
        trace::every_boundary(scene, medium, ray, found);
        for (std::size_t i = before; i < found.size(); ++i) found[i].index_matched = true;
    }
    const auto before = [](const trace::Crossing& a, const trace::Crossing& b) {
        return a.t < b.t || (a.t == b.t && a.primitive < b.primitive);
    };
    const auto same = [](const trace::Crossing& a, const trace::Crossing& b) {
        return a.t == b.t && a.primitive == b.primitive;  // a sphere that is touched
    };
    std::sort(found.begin(), found.end(), before);
    found.erase(std::unique(found.begin(), found.end(), same), found.end());
}

}  // namespace

void CompiledScene::all_hits(const Ray& ray, std::vector<RayHit>& hits) const {
    const FloatEnvironment environment;
    hits.clear();
    if (!query::is_fit(ray)) return;
    std::vector<trace::Crossing>& found = scratch();
    find_all(*scene_, ray, found);
    hits.reserve(found.size());
    for (const trace::Crossing& c : found)
        hits.push_back(query::complete(*scene_, {{c.t, c.primitive}, c.u, c.v, c.index_matched}));
}

std::vector<RayHit> CompiledScene::all_hits(const Ray& ray) const {
    std::vector<RayHit> hits;
    all_hits(ray, hits);
    return hits;
}

}  // namespace limn
