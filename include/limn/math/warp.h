/// \file
/// Maps from uniform random numbers to directions, points and distances, with their densities. The numbers u, v and w
/// are independent and uniform in [0, 1). Directions are in a frame whose z axis is the pole; Frame::to_world turns
/// them to the world. All functions are pure.
#pragma once

#include "limn/math/vec.h"

namespace limn {

/// Return a unit vector in the upper hemisphere, and its density cos / pi per solid angle. A point in the disc
/// (sample_uniform_disc) is projected up to the hemisphere (Malley's method). The density is 0 for a negative cosine.
///@{
Vec3 sample_cosine_hemisphere(double u, double v);
double pdf_cosine_hemisphere(double cos_theta);
///@}

/// Return a unit vector on the whole sphere, and its density 1 / (4 pi) per solid angle. The vector's z is uniform
/// (Archimedes).
///@{
Vec3 sample_uniform_sphere(double u, double v);
double pdf_uniform_sphere();
///@}

/// Returns a point in the closed unit disc, with z = 0 and density 1 / pi per area (Shirley and Chiu, A Low Distortion
/// Map Between Disk and Square, Journal of Graphics Tools 2(3), 1997).
Vec3 sample_uniform_disc(double u, double v);

/// Returns a point in the unit ball, with density 3 / (4 pi) per volume. Its radius is the cube root of w.
Vec3 sample_uniform_ball(double u, double v, double w);

/// Return a unit vector whose cosine with z is at least cos_max, and its density 1 / (2 pi (1 - cos_max)) per solid
/// angle. The parameter is 1 - cos_max, because cos_max of a small cone would be rounded to 1.
/// \pre 0 < one_minus_cos_max <= 2
///@{
Vec3 sample_uniform_cone(double u, double v, double one_minus_cos_max);
double pdf_uniform_cone(double one_minus_cos_max);
///@}

/// Returns the barycentric weights of the second and third vertex of a point in a triangle. The point is uniform, with
/// density 1 / area (Heitz, A Low-Distortion Map Between Triangle and Square, 2019).
Uv sample_uniform_triangle(double u, double v);

/// Return a free-flight distance d = -log1p(-u) / sigma in a medium of extinction sigma, and its density sigma
/// exp(-sigma d) per length. The distance is infinite if sigma is 0. The density is 0 for a negative distance.
///@{
double sample_exponential(double u, double sigma);
double pdf_exponential(double distance, double sigma);
///@}

}  // namespace limn
