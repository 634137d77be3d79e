#pragma once

#include "flat/scene.h"
#include "limn/math/surface.h"

namespace limn::shade {

// Returns the albedo of a surface: the share of the light from along its normal that it scatters. It is the mean weight
// of samples of the lobe for a few fixed random numbers. If all samples have the same weight, the albedo is exact.
Color albedo(const flat::Scene& scene, const Surface& surface);

}  // namespace limn::shade
