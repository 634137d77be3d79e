// A ray as the packed primitives of a leaf see it, in float: BoxRay's t, but space as it is.
#pragma once

#include <cmath>
#include <cstddef>

#include "kernels/box_ray.h"

namespace limn::kernels {

// What the origin and packed coordinates, which are off by coordinate_error, may add to the error of a difference,
// twice: for 2^-46 of the origin is what two floats leave out. Infinite, so that the float forms decide nothing, where
// products may overflow or underflow.
HWY_INLINE float absolute_error(const BoxRay& ray, float coordinate_error) {
    const bool is_in_range = ray.extent > 0x1p-30f && ray.extent < 0x1p50f && ray.origin_error < 0x1p50f;
    const float error = 4 * (ray.origin_error + coordinate_error) + 0x1p-44f * ray.reach + 0x1p-45f;
    return is_in_range ? error : std::numeric_limits<float>::infinity();
}

// Without branches, which could not be predicted: magnitudes compare as their bits do.
HWY_INLINE unsigned longest_axis(const float* v) {
    const auto bits = [&](std::size_t a) { return std::bit_cast<std::uint32_t>(v[a]) << 1; };
    const unsigned is_y = bits(1) > bits(0), over_x = bits(2) > bits(0), over_y = bits(2) > bits(1);
    const unsigned is_z = over_x & over_y;
    return is_z * 2 + (is_y & ~is_z);
}

// For triangles and quads: ShearedRay in float. With u = 2^-24 and M the largest coordinate of a vertex seen from the
// origin, such a coordinate is off by 2 u M and by what absolute_error says; the shear by 4 u; a sheared coordinate, by
// the reasoning there, by (2 + 2 + 4 + 3) u M and twice that; products of two add 2 u P^2, P <= 2 M: E = relative M +
// absolute, determinants by 4 (P + E) E.
struct PlanarRay {
    unsigned x, y, z;  // the axes, permuted
    float high[3], low[3];
    float shear_x, shear_y;
    float relative, absolute;
    float direction_error;  // of z, relative
    float t_from_z;
    bool starts_at_origin;       // t_min is not negative: nothing behind the origin counts
    float coarse_slope, coarse;  // the error of determinants with E for the farthest vertex: 4 E P + 4 E^2

    // `vertex_error`: how far packed coordinates are from those that they stand for.
    HWY_INLINE PlanarRay(const BoxRay& ray, float vertex_error) : absolute(absolute_error(ray, vertex_error)) {
        z = longest_axis(ray.direction);
        x = 9u >> (2 * z) & 3;   // 1 2 0
        y = 18u >> (2 * z) & 3;  // 2 0 1
        const float inverse = ray.inverse[z];
        shear_x = ray.direction[x] * inverse;
        shear_y = ray.direction[y] * inverse;
        high[0] = ray.high[x], high[1] = ray.high[y], high[2] = ray.high[z];
        low[0] = ray.low[x], low[1] = ray.low[y], low[2] = ray.low[z];
        t_from_z = ray.scale * inverse;
        starts_at_origin = ray.t_min >= 0 && ray.t_start == 0;
        direction_error = 4 * ray.direction_error;
        relative = 16 * 0x1p-24f + 1.01f * direction_error;
        const float farthest = relative * 2 * ray.reach + absolute;
        coarse_slope = 4.001f * farthest;
        coarse = coarse_slope * farthest;
    }
};

// For spheres: SphereRay in float. The foot point is off by (2 + 10 + 8 * 2) u L + e, see filter_sphere.
struct RoundRay {
    const float *high, *low, *direction;  // BoxRay's
    float inverse_squared;                // of the direction's length
    float inverse_length;                 // at least 1 / length
    float relative, absolute;
    float t_scale;

    HWY_INLINE RoundRay(const BoxRay& ray, float center_error)
        : high(ray.high), low(ray.low), direction(ray.direction), absolute(absolute_error(ray, center_error)) {
        const float* d = direction;
        inverse_squared = 1 / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        const float x = std::abs(ray.inverse[0]), y = std::abs(ray.inverse[1]), z = std::abs(ray.inverse[2]);
        const float xy = x < y ? x : y;
        inverse_length = (xy < z ? xy : z) * (1 + 0x1p-20f);  // along the longest
        relative = 48 * 0x1p-24f + 16 * ray.direction_error;
        t_scale = ray.scale;
    }
};

}  // namespace limn::kernels
