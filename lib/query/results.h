// Helpers that the queries of rays share: the conversion of hits into RayHit, and memory for lists of hits.
#pragma once

#include <algorithm>
#include <vector>

#include "flat/scene.h"
#include "limn/query/compiled_scene.h"
#include "trace/traverse.h"

namespace limn::query {

// Converts a hit of the traversal into the form that queries return. \pre the hit is not a miss
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

// An empty list for the hits along one ray. It reuses memory that is kept for the thread, so that a query usually
// allocates nothing. Lists may be nested, because a user-defined shape may query a scene during a query: the inner list
// allocates memory of its own.
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

// Sorts hits by t and, if t is equal, by the number of the primitive.
inline void sort_along_ray(std::vector<trace::Crossing>& hits) {
    std::sort(hits.begin(), hits.end(), [](const trace::Crossing& a, const trace::Crossing& b) {
        return a.t < b.t || (a.t == b.t && a.primitive < b.primitive);
    });
}

}  // namespace limn::query
