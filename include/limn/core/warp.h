/// \file
/// Maps from the unit square or cube to directions and points, each beside its density. Pure. u, v, w in [0, 1),
/// uniform and independent. Directions are in the frame whose z axis is the pole; Frame turns them.
#pragma once

#include "limn/core/vec.h"

namespace limn {

/// Unit vector in the upper hemisphere, density cos / pi per solid angle: Shirley and Chiu's concentric map, raised to
/// the hemisphere (Malley's method). The density is 0 for a negative cosine.
///@{
Vec3 sample_cosine_hemisphere(double u, double v);
double pdf_cosine_hemisphere(double cos_theta);
///@}

/// Unit vector on the whole sphere, density 1 / (4 pi) per solid angle: z is uniform (Archimedes).
///@{
Vec3 sample_uniform_sphere(double u, double v);
double pdf_uniform_sphere();
///@}

/// Point in the closed unit disc (z = 0), density 1 / pi per area (Shirley and Chiu, A Low Distortion Map Between Disk
/// and Square, Journal of Graphics Tools 2(3), 1997).
Vec3 sample_uniform_disc(double u, double v);

/// Point in the unit ball, density 3 / (4 pi) per volume: the radius is the cube root of w.
Vec3 sample_uniform_ball(double u, double v, double w);

/// Unit vector whose cosine with z is at least cos_max, density 1 / (2 pi (1 - cos_max)) per solid angle. The
/// difference is the parameter because it vanishes for distant lights. \pre 0 < one_minus_cos_max <= 2
///@{
Vec3 sample_uniform_cone(double u, double v, double one_minus_cos_max);
double pdf_uniform_cone(double one_minus_cos_max);
///@}

/// Weights of the second and third vertex of a point uniform in a triangle, density 1 / area (Heitz, A Low-Distortion
/// Map Between Triangle and Square, 2019).
Uv sample_uniform_triangle(double u, double v);

/// Distance of free flight through extinction sigma, by -log1p(-u) / sigma, density sigma exp(-sigma d) per length;
/// infinite where sigma is 0. The density is 0 for a negative distance.
///@{
double sample_exponential(double u, double sigma);
double pdf_exponential(double distance, double sigma);
///@}

}  // namespace limn
