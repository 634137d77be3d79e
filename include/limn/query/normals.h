/// \file
/// Normals of many hits.
#pragma once

#include <span>

#include "limn/query/compiled_scene.h"

namespace limn {

/// The unit normal of the outward side where each ray has hit, whichever side it came from: that of
/// CompiledScene::surface_at, in less time. Zero for a miss. \pre hits were found for these rays in this scene, as for
/// surface_at \throws ArgumentError if spans differ in length
void outward_normals(const CompiledScene& scene, std::span<const Ray> rays, std::span<const RayHit> hits,
                     std::span<Vec3> normals);

}  // namespace limn
