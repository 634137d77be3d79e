// What all queries share: which rays can be traced, and hits as they are reported.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "flat/scene.h"
#include "limn/query/compiled_scene.h"
#include "trace/traverse.h"

namespace limn::query {

inline RayHit complete(const flat::Scene& scene, const trace::Hit& hit) {
    const std::size_t object = flat::object_of(scene, hit.primitive);
    return {.t = hit.t,
            .object = static_cast<std::uint32_t>(object),
            .element = hit.primitive - scene.first_of_object[object],
            .u = hit.u,
            .v = hit.v,
            .index_matched = hit.index_matched,
            .primitive = hit.primitive};
}

inline RayHit complete(const flat::Scene& scene, const trace::Crossing& c) {
    return complete(scene, trace::Hit{{c.t, c.primitive}, c.u, c.v, c.index_matched});
}

// is_usable, sooner for most: a sum of magnitudes tells whether all are finite.
inline bool is_fit(const Ray& r) {
    const double across = std::abs(r.direction.x) + std::abs(r.direction.y) + std::abs(r.direction.z);
    const double all = std::abs(r.origin.x) + std::abs(r.origin.y) + std::abs(r.origin.z) + std::abs(r.time) + across;
    return all < kInfinity && across > 0 ? r.t_min <= r.t_max && r.t_min < kInfinity : is_usable(r);
}

// What is found along a ray: empty, and of a thread, so that a ray costs no allocation. One at a time; user-defined
// shapes that query a scene themselves get another.
class Found {
public:
    Found() : hits_(std::move(kept())) { hits_.clear(); }
    ~Found() { kept() = std::move(hits_); }
    Found(const Found&) = delete;
    Found& operator=(const Found&) = delete;

    std::vector<trace::Crossing>& operator*() { return hits_; }

private:
    static std::vector<trace::Crossing>& kept() {
        thread_local std::vector<trace::Crossing> hits;
        return hits;
    }
    std::vector<trace::Crossing> hits_;
};

inline void sort_along_ray(std::vector<trace::Crossing>& hits) {
    std::sort(hits.begin(), hits.end(), [](const trace::Crossing& a, const trace::Crossing& b) {
        return a.t < b.t || (a.t == b.t && a.primitive < b.primitive);
    });
}

}  // namespace limn::query
