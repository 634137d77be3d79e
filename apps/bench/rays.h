/// \file
/// The rays that everybody is asked: made once, from limn's exact hits, with float32 components.
#pragma once

#include <string>
#include <vector>

#include "bench/geometry.h"
#include "limn/core/ray.h"
#include "limn/render/compiled_scene.h"

namespace limn::bench {

struct RaySet {
    std::string name;
    bool any = false;       // whether there is a hit; else the nearest
    bool coherent = false;  // neighbours go much the same way
    std::vector<Ray> rays;
};

// primary, diffuse1 to diffuse3, ambient occlusion and shadow, some `count` rays each: fewer where paths leave the
// scene too soon, and none of a kind for which there is no ray at all. The same ones each time.
std::vector<RaySet> make_rays(const Geometry& geometry, const CompiledScene& scene, std::size_t count);

}  // namespace limn::bench
