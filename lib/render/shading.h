// Materials and textures of the compiled scene: the packed ones without a virtual call, foreign ones through thunks.
#pragma once

#include <optional>

#include "flat/scene.h"
#include "limn/core/surface.h"

namespace limn::tracing {

Color texture_value(const flat::Scene& scene, TextureId id, const Surface& s);

// The same three questions as Material's.
Color emitted(const flat::Scene& scene, const Surface& s);
std::optional<ScatterSample> sample_material(const flat::Scene& scene, const Surface& s, const Vec3& out,
                                             const Random3& random);
ScatterValue material_value(const flat::Scene& scene, const Surface& s, const Vec3& out, const Vec3& in);

// False for materials whose value is zero for every pair of directions: lights need not be sampled for them.
bool can_be_evaluated(const flat::Scene& scene, const MaterialRef& material);

// Whether the value is zero wherever the two directions are on different sides of the geometric surface. False in
// media, which have no sides.
bool scatters_back_only(const flat::Scene& scene, const MaterialRef& material);

}  // namespace limn::tracing
