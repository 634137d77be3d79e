#pragma once

#include "flat/scene.h"
#include "limn/math/surface.h"

namespace limn::shade {

// The light that a surface scatters of what comes from straight above, or goes there: the mean weight of its lobe's
// samples for a few fixed numbers, which is exact where all weigh the same.
Color albedo(const flat::Scene& scene, const Surface& surface);

}  // namespace limn::shade
