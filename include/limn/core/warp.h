/// \file
/// Maps from the unit square or cube to directions and points, each beside its density. Pure; u in [0, 1).
#pragma once

#include "limn/core/vec.h"

namespace limn {

/// Unit vector in the upper hemisphere (local z up), density cos / pi per solid angle.
/// Shirley and Chiu's concentric map, raised to the hemisphere (Malley's method).
Vec3 sample_cosine_hemisphere(double u, double v);
double pdf_cosine_hemisphere(double cos_theta);

/// Unit vector on the whole sphere, density 1 / (4 pi).
Vec3 sample_uniform_sphere(double u, double v);
double pdf_uniform_sphere();

/// Point in the closed unit disc (z = 0), density 1 / pi per area (Shirley and Chiu, A Low Distortion Map Between Disk
/// and Square, 1997).
Vec3 sample_uniform_disc(double u, double v);

/// Point in the unit ball, density 3 / (4 pi) per volume.
Vec3 sample_uniform_ball(double u, double v, double w);

/// Unit vector within `cos_max` of local z, uniform per solid angle. `one_minus_cos_max` is given apart because it
/// vanishes for distant lights. density 1 / (2 pi one_minus_cos_max).
Vec3 sample_uniform_cone(double u, double v, double one_minus_cos_max);
double pdf_uniform_cone(double one_minus_cos_max);

/// Weights of the second and third vertex of a point uniform in a triangle.
Uv sample_uniform_triangle(double u, double v);

/// Distance of free flight through extinction sigma, by -log1p(-u) / sigma; density sigma exp(-sigma d).
double sample_exponential(double u, double sigma);
double pdf_exponential(double distance, double sigma);

}  // namespace limn
