// What all queries share: which rays can be asked, and hits as they are told.
#pragma once

#include <algorithm>
#include <cmath>

#include "flat/scene.h"
#include "limn/query/compiled_scene.h"
#include "trace/traverse.h"

namespace limn::query {

inline std::size_t object_of(const flat::Scene& scene, std::uint64_t primitive) {
    if (!scene.object_of.empty()) return scene.object_of[primitive];
    if (scene.first_of_object.size() <= 1) return 0;
    const auto after = std::upper_bound(scene.first_of_object.begin(), scene.first_of_object.end(), primitive);
    return static_cast<std::size_t>(after - scene.first_of_object.begin() - 1);
}

inline RayHit complete(const flat::Scene& scene, const trace::Hit& hit) {
    const std::size_t object = object_of(scene, hit.primitive);
    return {.t = hit.t,
            .object = static_cast<std::uint32_t>(object),
            .element = hit.primitive - scene.first_of_object[object],
            .u = hit.u,
            .v = hit.v,
            .index_matched = hit.index_matched,
            .primitive = hit.primitive};
}

// is_usable, sooner for most: a sum of magnitudes tells whether all are finite.
inline bool is_fit(const Ray& r) {
    const double across = std::abs(r.direction.x) + std::abs(r.direction.y) + std::abs(r.direction.z);
    const double all = std::abs(r.origin.x) + std::abs(r.origin.y) + std::abs(r.origin.z) + std::abs(r.time) + across;
    return all < kInfinity && across > 0 ? r.t_min <= r.t_max && r.t_min < kInfinity : is_usable(r);
}

}  // namespace limn::query
