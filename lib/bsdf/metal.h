// A mirror, blurred by a displacement drawn uniformly in a ball. No Fresnel term.
#pragma once

#include <optional>

#include "limn/core/surface.h"

namespace limn::bsdf {

/// f |cos| and its density; zero where the lobe is a mirror's.
ScatterValue value_metal(const Color& albedo, double fuzz, const Surface& s, const Vec3& out, const Vec3& in);

/// What ends below the geometric surface is absorbed. pdf 0 where the lobe is a mirror's.
std::optional<ScatterSample> sample_metal(const Color& albedo, double fuzz, const Surface& s, const Vec3& out,
                                          const Random3& random);

}  // namespace limn::bsdf
