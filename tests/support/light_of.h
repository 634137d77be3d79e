// Returns lights of a scene.
#pragma once

#include "flat/scene.h"

namespace limn::test {

inline flat::Light light_of(const flat::Scene& scene, std::size_t rank, double time) {
    flat::Light room;
    return flat::light_at(scene, rank, time, room);
}

// Returns the light as a surface, or null if it is none.
inline const flat::SurfaceLight* surface_of(const flat::Light& light) {
    if (const auto* sphere = std::get_if<flat::SphereLight>(&light)) return sphere;
    return std::get_if<flat::PlanarLight>(&light);
}

}  // namespace limn::test
