// A ray as the boxes of a group see it, in float.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/filter.h"
#include "core/ray_frame.h"
#include "flat/scene.h"

namespace limn::kernels {

// A plane of a box at p is met at t = p * inverse + shift, in steps of the ray scaled: its direction by a power of two,
// so that the largest coordinate is in [1, 2), and space by Group::scale, so that boxes lie within [-1, 1]. A ray that
// starts far away starts anew where it comes closest to the middle. So one path serves all magnitudes.
//
// Conservative: let R = 1 + |origin| and u = 2^-24. Origin and direction are off by u each, the reciprocal by 2 u more,
// products and sums by u each: t by at most 8 u R / |d_a| along axis a, which is less than half of what `wider` moves
// near planes back and far planes on. The rest of it covers that the t of hits may be off by 2^-32 of R, and the
// rounding of t_max. Ize, Robust BVH Ray Traversal, JCGT 2(2), 2013, has the idea.
//
// A direction that hardly moves along an axis, by less than 2^-60 of its length, is made that long: inside or near the
// slab, `wider` makes both planes lie beyond all boxes, in front and behind; else the box is missed sooner or later
// than it should be, in any case.
struct BoxRay {
    float inverse[3], near_shift[3], far_shift[3];
    float t_min;
    float slack;              // of t
    unsigned octant;          // bit a: direction[a] is negative
    double t_scale, t_start;  // the t of here is t * t_scale - t_start
    // For the leaves: the ray in space as it is, but its direction scaled; off by origin_error and direction_error.
    Point3 origin;
    Vec3 direction;
    double origin_error, direction_error;
    double scale;  // Group::scale

    BoxRay(const RayFrame& frame, const flat::Group& group) : scale(group.scale) {
        const Ray& ray = frame.ray;
        double unit = reciprocal_power(max_abs(ray.direction));
        direction = unit * ray.direction;
        direction_error = unit * frame.direction_error;
        t_scale = scale / unit;
        t_start = 0;
        origin = ray.origin;
        origin_error = frame.origin_error;

        Point3 at = Point3{} + scale * (origin - Point3{});
        double reach = max_abs(at) + 1;
        double lost = scale * origin_error, t_lost = 0;
        if (reach > kFar) {
            t_start = dot(Point3{} - at, direction) / dot(direction, direction);
            at = at + t_start * direction;
            lost += 0x1p-48 * reach + direction_error * std::abs(t_start);
            t_lost = 0x1p-30 * reach;
            reach = max_abs(at) + 1;
            origin = Point3{} + (1 / scale) * (at - Point3{});
            origin_error = lost / scale;
        }
        const double wider = 0x1p-20 * reach + 2 * (lost + direction_error * reach);
        slack = static_cast<float>(wider + t_lost);
        octant = 0;
        t_min = lower(ray.t_min);
        for (std::size_t a = 0; a < 3; ++a) {
            const double along = std::abs(direction[a]) < 0x1p-60 ? std::copysign(0x1p-60, direction[a]) : direction[a];
            octant |= std::signbit(along) ? 1u << a : 0u;
            inverse[a] = 1 / static_cast<float>(along);
            const float shift = -static_cast<float>(at[a]) * inverse[a];
            const float widening = static_cast<float>(wider) * std::abs(inverse[a]);
            near_shift[a] = shift - widening;
            far_shift[a] = shift + widening;
        }
        if (wider + t_lost < 0x1p50 && direction_error < 0x1p-3 && max_abs(direction) >= 1 && t_scale > 0x1p-1000 &&
            t_scale < kInfinity)
            return;
        // Nothing is known of where the ray goes: every box is met, but an absent one, whose sides are infinite.
        octant = 0;
        t_min = -std::numeric_limits<float>::infinity();
        t_start = -kInfinity;
        for (std::size_t a = 0; a < 3; ++a) {
            inverse[a] = 1;
            near_shift[a] = -std::numeric_limits<float>::max();
            far_shift[a] = std::numeric_limits<float>::max();
        }
        origin_error = kInfinity;
    }

    // Bounds on t as it is here. Where the t of boxes is rounded by more than `slack` there are no boxes.
    float upper(double t) const {
        const double here = t * t_scale - t_start;
        if (!(here < kLargest)) return std::numeric_limits<float>::infinity();
        return static_cast<float>(larger(here, -kLargest)) + slack;
    }
    float lower(double t) const {
        const double here = t * t_scale - t_start;
        if (!(here > -kLargest)) return -std::numeric_limits<float>::infinity();
        return static_cast<float>(smaller(here, kLargest)) - slack;
    }

private:
    static constexpr double kFar = 5;  // near enough that moving the origin would not pay
    static constexpr double kLargest = 0x1p120;

    // 2^-e for x in [2^e, 2^(e + 1)).
    static double reciprocal_power(double x) {
        const auto exponent = static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff);
        if (exponent == 0 || exponent > 2040) return std::ldexp(1.0, std::min(-std::ilogb(x), 1000));
        return std::bit_cast<double>(static_cast<std::uint64_t>(2046 - exponent) << 52);
    }
};

}  // namespace limn::kernels
