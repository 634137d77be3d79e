// A smooth interface between two clear media. `eta` is the index on the far side over the index on the incident side.
#pragma once

#include <optional>

#include "limn/core/fresnel.h"
#include "limn/core/surface.h"

namespace limn::bsdf {

/// Cosine of the refracted direction by Snell's law; 0 at and beyond the critical angle, and where eta^2 leaves the
/// range of double, where all light is reflected. \param cos_incident in [0, 1]
double cos_transmitted(double cos_incident, double eta);

/// Fresnel's equations, mean of both polarisations. 1 under total reflection, 0 for eta 1. In [0, 1].
/// \param cos_incident clamped to [0, 1]
double reflectance_exact(double cos_incident, double eta);

/// Schlick's approximation on the incident-side cosine whichever side that is, as the books have it; 1 under total
/// reflection. In [0, 1]. \param cos_incident clamped to [0, 1]
double reflectance_schlick(double cos_incident, double eta);

/// Reflects where random.x is below the reflectance, else refracts: weight 1, pdf 0. Absorbed where an interpolated
/// normal sends the direction to the wrong side of the geometric surface.
/// \param index of the inside, behind the shape's outward normal, relative to the outside
std::optional<ScatterSample> sample_dielectric(double index, Fresnel fresnel, const Surface& s, const Vec3& out,
                                               const Random3& random);

}  // namespace limn::bsdf
