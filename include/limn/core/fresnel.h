/// \file
#pragma once

#include <cstdint>

namespace limn {

/// The reflectance of a dielectric: Fresnel's equations for unpolarised light, or Schlick's approximation with the
/// incident-side cosine on both sides, as the books have it.
enum class Fresnel : std::uint8_t { exact, schlick };

}  // namespace limn
