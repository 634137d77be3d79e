/// \file
/// The choice of a dielectric's reflectance.
#pragma once

#include <cstdint>

namespace limn {

/// The reflectance of a dielectric: Fresnel's equations for unpolarised light (Born and Wolf, Principles of Optics, 7th
/// ed., section 1.5.2), or Schlick's approximation (An Inexpensive BRDF Model for Physically-based Rendering, 1994)
/// with the incident-side cosine on both sides, as in Shirley, Ray Tracing in One Weekend.
enum class Fresnel : std::uint8_t { exact, schlick };

}  // namespace limn
