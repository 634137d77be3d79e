#include "trace/walk_ray.h"

#include <algorithm>
#include <cmath>

namespace limn::trace {

AdaptedRay::AdaptedRay(const RayFrame& frame, const flat::Blas& blas) {
    // Scale the direction and the boxes.
    const Ray& ray = frame.ray;
    const double unit = std::ldexp(1.0, std::min(-std::ilogb(max_abs(ray.direction)), 1000));
    const Vec3 along = unit * ray.direction;  // its largest coordinate in [1, 2)
    const double along_error = unit * frame.direction_error;
    t_scale = blas.scale / unit;
    Point3 at = Point3{} + blas.scale * (ray.origin - Point3{}), origin = ray.origin;
    const double box_extent = blas.scale * blas.extent;
    double box_reach = max_abs(at) + box_extent;
    double at_error = blas.scale * frame.origin_error, t_start_error = 0;
    // If the ray comes from far away, count t from where it is closest to the middle.
    if (box_reach > kFar * box_extent) {
        t_start = dot(Point3{} - at, along) / dot(along, along);
        at = at + t_start * along;
        at_error += 0x1p-48 * box_reach + along_error * std::abs(t_start);
        t_start_error = 0x1p-30 * box_reach;
        box_reach = max_abs(at) + box_extent;
        origin = Point3{} + (1 / blas.scale) * (at - Point3{});
    }
    // Set the numbers for boxes.
    const double wider = static_cast<double>(kWider) * box_reach + 2 * (at_error + along_error * box_reach);
    float direction[3] = {1, 1, 1}, high[3] = {}, low[3] = {};
    octant = 0;
    if (wider + t_start_error < 0x1p50 && along_error < 0x1p-3 && max_abs(along) >= 1 && t_scale > 0x1p-1000 &&
        t_scale < kInfinity) {
        t_error = static_cast<float>(t_start_error);
        for (std::size_t a = 0; a < 3; ++a) {
            high[a] = static_cast<float>(origin[a]);
            low[a] = static_cast<float>(origin[a] - static_cast<double>(high[a]));
            direction[a] = static_cast<float>(along[a]);
            inverse[a] = 1 / std::copysign(std::max(std::abs(direction[a]), kLeast), direction[a]);
            const float shift = -static_cast<float>(at[a]) * inverse[a];
            const float widening = static_cast<float>(wider) * std::abs(inverse[a]);
            near_shift[a] = shift - widening;
            far_shift[a] = shift + widening;
            octant |= std::signbit(direction[a]) ? 1u << a : 0u;
        }
        t_min = lower(ray.t_min);
        excludes_behind = t_min >= 0 && t_start == 0;
        set_leaves(direction, high, low, blas, static_cast<float>(at_error / blas.scale),
                   static_cast<float>(along_error));
        return;
    }
    // Float holds nothing of the ray. Let it meet every box but absent ones, whose sides are infinite, and let the
    // float tests of primitives have infinite error bounds.
    t_min = -std::numeric_limits<float>::infinity();
    t_start = -kInfinity;
    excludes_behind = false;
    for (std::size_t a = 0; a < 3; ++a) {
        inverse[a] = 1;
        near_shift[a] = -std::numeric_limits<float>::max();
        far_shift[a] = std::numeric_limits<float>::max();
    }
    set_leaves(direction, high, low, blas, std::numeric_limits<float>::infinity(), 0);
}

void AdaptedRay::set_leaves(const float* direction, const float* high, const float* low, const flat::Blas& blas,
                            float origin_error, float direction_error) {
    const auto largest = [](const float* v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); };
    const auto extent = static_cast<float>(blas.extent), scale = static_cast<float>(smaller(blas.scale, 0x1p100));
    const float reach = largest(high) + extent;
    // If products may overflow or underflow, the error is infinite. Then the float tests decide nothing.
    const bool is_in_range = extent > 0x1p-30f && extent < 0x1p50f && origin_error < 0x1p50f;
    const float absolute = is_in_range ? 4 * (origin_error + blas.packed_error) + 0x1p-44f * reach + 0x1p-45f
                                       : std::numeric_limits<float>::infinity();
    // Set the numbers for triangles and quads.
    const float length = largest(direction);
    const std::uint32_t z = std::abs(direction[0]) == length ? 0 : std::abs(direction[1]) == length ? 1 : 2;
    for (std::uint32_t a = 0; a < 3; ++a) rows[a] = (z + 1 + a) % 3;
    const float relative = 16 * 0x1p-24f + 4.04f * direction_error;
    const float farthest = relative * 2 * reach + absolute, slope = 4.001f * farthest;
    const float shear_x = direction[rows[0]] / direction[z], shear_y = direction[rows[1]] / direction[z];
    std::copy_n(std::initializer_list<float>{high[rows[0]], high[rows[1]], high[z], relative, low[rows[0]],
                                             low[rows[1]], low[z], absolute, shear_x, shear_y, -scale / direction[z],
                                             4 * direction_error, low[rows[0]] - shear_x * low[z],
                                             low[rows[1]] - shear_y * low[z], slope, slope * farthest}
                    .begin(),
                16, planar);
    // Set the numbers for spheres. The direction is scaled so that t is that of boxes.
    const float d[3] = {direction[0] / scale, direction[1] / scale, direction[2] / scale};
    std::copy_n(std::initializer_list<float>{high[0], high[1], high[2], 1 / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]),
                                             low[0], low[1], low[2], (1 + 0x1p-20f) / largest(d), d[0], d[1], d[2],
                                             48 * 0x1p-24f + 16 * direction_error, absolute}
                    .begin(),
                13, round);
}

}  // namespace limn::trace
