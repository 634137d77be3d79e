#include "limn/core/warp.h"

#include <algorithm>
#include <cmath>

#include "limn/core/math.h"

namespace limn {

namespace {

// Unit vector at the given angle around z; `sine` is that of the angle from z.
Vec3 around_z(double sine, double cosine, double phi) { return {sine * std::cos(phi), sine * std::sin(phi), cosine}; }

}  // namespace

Vec3 sample_cosine_hemisphere(double u, double v) {
    const Vec3 disc = sample_uniform_disc(u, v);
    return {disc.x, disc.y, std::sqrt(std::max(0.0, 1 - length_squared(disc)))};
}

double pdf_cosine_hemisphere(double cos_theta) { return std::max(0.0, cos_theta) / kPi; }

// Archimedes: the height on the sphere is uniform in [-1, 1]. 1 - (1 - 2u)^2 = 4 u (1 - u), without the cancellation.
Vec3 sample_uniform_sphere(double u, double v) { return around_z(2 * std::sqrt(u * (1 - u)), 1 - 2 * u, 2 * kPi * v); }

double pdf_uniform_sphere() { return 1 / (4 * kPi); }

// Squares around the centre become circles; each quarter of the square is one quarter of the disc.
Vec3 sample_uniform_disc(double u, double v) {
    const double a = 2 * u - 1, b = 2 * v - 1;
    if (a == 0 && b == 0) return {};
    const bool wide = std::abs(a) > std::abs(b);
    const double radius = wide ? a : b;
    const double phi = wide ? kPi / 4 * (b / a) : kPi / 2 - kPi / 4 * (a / b);
    return {radius * std::cos(phi), radius * std::sin(phi), 0};
}

Vec3 sample_uniform_ball(double u, double v, double w) { return std::cbrt(w) * sample_uniform_sphere(u, v); }

Vec3 sample_uniform_cone(double u, double v, double one_minus_cos_max) {
    const double one_minus_cos = u * one_minus_cos_max;
    return around_z(std::sqrt(one_minus_cos * (2 - one_minus_cos)), 1 - one_minus_cos, 2 * kPi * v);
}

double pdf_uniform_cone(double one_minus_cos_max) { return 1 / (2 * kPi * one_minus_cos_max); }

// Heitz, A Low-Distortion Map Between Triangle and Square, 2019.
Uv sample_uniform_triangle(double u, double v) { return v > u ? Uv{u / 2, v - u / 2} : Uv{u - v / 2, v / 2}; }

double sample_exponential(double u, double sigma) { return sigma > 0 ? -std::log1p(-u) / sigma : kInfinity; }

double pdf_exponential(double distance, double sigma) {
    return distance >= 0 ? sigma * std::exp(-sigma * distance) : 0;
}

}  // namespace limn
