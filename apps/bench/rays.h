/// \file
/// The rays that all renderers trace: made once, from limn's exact hits, with float32 components.
#pragma once

#include "bench/scenes.h"
#include "limn/core/ray.h"
#include "limn/query/compiled_scene.h"

namespace limn::bench {

struct RaySet {
    std::string name;
    bool any = false;       // whether there is a hit; else the nearest
    bool coherent = false;  // neighbours go much the same way
    std::vector<Ray> rays;
};

// "primary", "diffuse1" to "diffuse3", "occlusion" and "shadow".
const std::vector<std::string>& ray_kinds();

// Of each kind `count` rays: fewer where paths leave the scene too soon, and no set of a kind that has none at all.
// The same ones each time.
std::vector<RaySet> make_rays(const Geometry& geometry, const CompiledScene& scene, std::size_t count);

}  // namespace limn::bench
