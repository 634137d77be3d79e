// What all paths of a render have in common.
#pragma once

#include <cstdint>

#include "flat/scene.h"
#include "limn/render/settings.h"
#include "render/equiangular.h"
#include "shading/stages.h"

namespace limn::transport {

// The scene that paths are traced in, and the parameters of their estimator. The scene must outlive this object.
struct PathSettings {
    PathSettings(const flat::Scene& scene, int max_depth, Estimator estimator, bool transparent);

    const flat::Scene& scene;
    std::uint32_t max_depth;  // number of segments of the longest paths
    bool sample_lights;       // false for the naive estimator, or if the scene has no light that can be sampled
    bool transparent;         // true if the camera does not see the background
    LightsAsPivot pivot;
    shade::Roulette roulette;
};

}  // namespace limn::transport
