/// \file
/// The formulas for the reflectance of a dielectric.
#pragma once

#include <cstdint>

namespace limn {

/// A formula for the reflectance of a dielectric.
///
/// - `exact`: Fresnel's equations for unpolarised light (Born and Wolf, Principles of Optics, 7th ed., section 1.5.2).
/// - `schlick`: Schlick's approximation (An Inexpensive BRDF Model for Physically-based Rendering, 1994). It takes the
///   cosine of the incident direction on both sides of the surface, as in Shirley, Ray Tracing in One Weekend.
enum class Fresnel : std::uint8_t { exact, schlick };

}  // namespace limn
