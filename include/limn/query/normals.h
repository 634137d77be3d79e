/// \file
/// The normals of many hits.
#pragma once

#include <span>

#include "limn/query/compiled_scene.h"

namespace limn {

/// Writes the outward unit normal of the surface at each hit, whichever side the ray came from. It is the geometric
/// normal of CompiledScene::surface_at, computed faster. A miss gets the zero vector.
/// \pre hits[i] was found in `scene` for rays[i], as for surface_at
/// \throws ArgumentError if spans differ in length
void outward_normals(const CompiledScene& scene, std::span<const Ray> rays, std::span<const RayHit> hits,
                     std::span<Vec3> normals);

}  // namespace limn
