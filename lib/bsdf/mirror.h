#pragma once

#include "limn/core/vec.h"

namespace limn::bsdf {

/// The mirror image of `out` about `normal`; unit if both are. All directions point away from the surface.
inline Vec3 mirror(const Vec3& out, const Normal3& normal) { return 2 * dot(out, normal) * Vec3(normal) - out; }

}  // namespace limn::bsdf
