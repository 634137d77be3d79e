// Surfaces with holes: materials with an opacity (limn/scene/material/alpha_mask.h).
#pragma once

#include <vector>

#include "flat/scene.h"
#include "limn/math/ray.h"
#include "query/surface_at.h"
#include "trace/traverse.h"

namespace limn::transport {

// What rays meet beyond holes. Asked where the nearest hit is on such a material, or a ray to a lamp is stopped: all
// hits of that ray are found then, and judged in order. Keeps its memory; one for each thread.
class Holes {
public:
    // The first hit that stops the ray. \param hit the nearest of all \param number uniform in [0, 1): whether
    // an opacity between 0 and 1 does; uniform again afterwards, for what lies beyond
    trace::Hit first_stop(const flat::Scene& scene, const Ray& ray, const trace::Hit& hit, double& number);
    // The share of light that arrives at the end of a ray, where something lies on the way.
    double transmittance(const flat::Scene& scene, const Ray& ray);

private:
    double opacity_of(const flat::Scene& scene, const Ray& ray, const trace::Hit& hit);

    std::vector<trace::Crossing> crossings_;
    query::SurfaceHit met_;
};

}  // namespace limn::transport
