// A ray as the packed primitives of a leaf see it, in float: BoxRay's t, but space as it is.
#pragma once

#include <cmath>
#include <cstddef>

#include "kernels/box_ray.h"

namespace limn::kernels {

// The ray's origin in two floats: v - high - low has two roundings of about v - origin, not of v.
struct SplitOrigin {
    float high[3], low[3];

    explicit SplitOrigin(const Point3& origin) {
        for (std::size_t a = 0; a < 3; ++a) {
            high[a] = static_cast<float>(origin[a]);
            low[a] = static_cast<float>(origin[a] - static_cast<double>(high[a]));
        }
    }
};

// Where the float forms of the intersections can be trusted: beyond, products may overflow or underflow.
inline bool is_in_float_range(const BoxRay& ray) {
    const double reach = 1 / ray.scale;  // at most twice the extent of the group
    return reach > 0x1p-30 && reach < 0x1p50 && ray.origin_error < 0x1p50;
}

// For triangles and quads: ShearedRay in float. With u = 2^-24 and M the largest coordinate of a vertex seen from the
// origin, such a coordinate is off by 2 u M, and by 2^-46 of the origin's own coordinates for what two floats leave
// out; the shear by u; a sheared coordinate, by the reasoning there, by (2 + 2 + 1 + 3) u M and twice what the origin
// and the vertices are off by; products of two add 2 u P^2, P <= 2 M: E = relative M + absolute, determinants by 4 (P +
// E) E.
struct PlanarRay {
    std::size_t x, y, z;  // the axes, permuted
    SplitOrigin origin;
    float shear_x, shear_y;
    float relative, absolute;
    float direction_error;  // of z, relative
    float t_from_z;

    // `vertex_error`: how far packed coordinates are from those that they stand for.
    PlanarRay(const BoxRay& ray, double vertex_error) : origin(ray.origin) {
        const Vec3& direction = ray.direction;
        const Vec3 d = abs(direction);
        z = d.x > d.y ? (d.x > d.z ? 0 : 2) : (d.y > d.z ? 1 : 2);
        x = z == 2 ? 0 : z + 1;
        y = x == 2 ? 0 : x + 1;
        const double inverse = 1 / direction[z];
        shear_x = static_cast<float>(direction[x] * inverse);
        shear_y = static_cast<float>(direction[y] * inverse);
        t_from_z = static_cast<float>(smaller(ray.scale, 0x1p100) * inverse);
        const double s = 4 * ray.direction_error;
        direction_error = static_cast<float>(s);
        relative = static_cast<float>(14 * 0x1p-24 + 1.01 * s);
        absolute = static_cast<float>(4 * (ray.origin_error + vertex_error) + 0x1p-44 * max_abs(ray.origin) + 0x1p-45);
        if (!is_in_float_range(ray)) absolute = std::numeric_limits<float>::infinity();
    }
};

// For spheres: SphereRay in float. The foot point is off by (2 + 10 + 8 * 2) u L + e, see filter_sphere.
struct RoundRay {
    SplitOrigin origin;
    float direction[3];
    float inverse_squared;  // of the direction's length
    float inverse_length;   // at least 1 / length
    float relative, absolute;
    float t_scale;

    RoundRay(const BoxRay& ray, double center_error) : origin(ray.origin) {
        for (std::size_t a = 0; a < 3; ++a) direction[a] = static_cast<float>(ray.direction[a]);
        const double squared = dot(ray.direction, ray.direction);
        inverse_squared = static_cast<float>(1 / squared);
        inverse_length = static_cast<float>(1 / max_abs(ray.direction));
        relative = static_cast<float>(32 * 0x1p-24 + 16 * ray.direction_error);
        absolute = static_cast<float>(4 * (ray.origin_error + center_error) + 0x1p-44 * max_abs(ray.origin) + 0x1p-45);
        t_scale = static_cast<float>(smaller(ray.scale, 0x1p100));
        if (!is_in_float_range(ray)) absolute = std::numeric_limits<float>::infinity();
    }
};

}  // namespace limn::kernels
