// A ray as the boxes of a BLAS see it, in float.
#pragma once

#include <hwy/base.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "flat/scene.h"
#include "geometry/filter.h"
#include "geometry/ray_frame.h"

namespace limn::trace {

// A plane of a box at p is met at t = p * inverse + shift. Nearly all rays are taken as they are; `adapt` brings those
// into range that start far away, have a very long or short direction, or come through an instance: it scales the
// direction by a power of two, counts t from another point of the ray, and widens boxes by what the ray may be off.
//
// Conservative: let R = |origin| + extent, and u = 2^-24. Origin and direction are off by u each, the reciprocal by 2 u
// more, products and sums by u each: t by at most 8 u R / |d_a| along axis a, half of what `wider` = 16 u R moves near
// planes back and far planes on. The rest of it covers that the t of hits may be off by 2^-32 of itself, and the
// rounding of t_min and t_max, 4 u R for what lies within reach. Ize, Robust BVH Ray Traversal, JCGT 2(2), 2013, has
// the idea.
//
// A direction that hardly moves along an axis, by less than kLeast, is made that long: inside or near the slab, `wider`
// makes both planes lie beyond all boxes, in front and behind; else the box is missed sooner or later than it should
// be, in any case.
struct BoxRay {
    // By axis; the fourth is there so that four can be worked out at once.
    alignas(16) float inverse[4], near_shift[4], far_shift[4];
    // For the leaves, in space as it is: the direction, and the origin in two floats, so that v - high - low has two
    // roundings of about v - origin, not of v.
    alignas(16) float direction[4], high[4], low[4];
    float reach;   // R, in space as it is
    float extent;  // Blas::extent
    float t_min;
    float t_error;  // of what is reported as t, beyond what above() allows: of a ray that starts anew
    float scale;    // of the boxes: Blas::scale
    float origin_error, direction_error;  // as in RayFrame, the direction's when the longest coordinate is 1
    bool is_taken_as_it_is;
    unsigned octant;          // bit a: direction[a] is negative
    double t_scale, t_start;  // the t of here is t * t_scale - t_start

    // Whether the ray is taken as it is. Sets what does not depend on axes, and `wider`. \pre direction, high and low
    // are set
    HWY_INLINE bool is_ordinary(const RayFrame& frame, const flat::Blas& blas, float& wider) {
        const float length = largest(direction);
        extent = static_cast<float>(blas.extent);
        reach = largest(high) + extent;
        t_error = origin_error = direction_error = 0;
        scale = 1;
        t_scale = 1, t_start = 0;
        wider = kWider * reach;
        is_taken_as_it_is = blas.scale == 1 && length > 0x1p-10f && length < 0x1p10f && reach < kFar * extent;
        if (HWY_UNLIKELY(frame.outer != nullptr)) {
            origin_error = static_cast<float>(frame.origin_error) * (1 + 0x1p-20f);
            direction_error = 2 * static_cast<float>(frame.direction_error) / length;
            wider += 2 * (origin_error + 2 * direction_error * reach);
            is_taken_as_it_is = is_taken_as_it_is && direction_error < 0x1p-10f && wider < reach;
        }
        return is_taken_as_it_is;
    }

    void adapt(const RayFrame& frame, const flat::Blas& blas);

    // t as it is here, but for its rounding to float.
    float upper(double t) const {
        const double here = t * t_scale - t_start;
        if (!(here < kLargest)) return std::numeric_limits<float>::infinity();
        return static_cast<float>(larger(here, -kLargest)) + t_error;
    }
    float lower(double t) const {
        const double here = t * t_scale - t_start;
        if (!(here > -kLargest)) return -std::numeric_limits<float>::infinity();
        return static_cast<float>(smaller(here, kLargest)) - t_error;
    }

    static constexpr float kLeast = 0x1p-60f, kWider = 0x1.01p-20f;

private:
    static constexpr float kFar = 8;  // times the extent: nearer, moving the origin would not pay
    static constexpr double kLargest = 0x1p120;

    static HWY_INLINE float largest(const float* v) {
        const float x = std::abs(v[0]), y = std::abs(v[1]), z = std::abs(v[2]), xy = x > y ? x : y;
        return xy > z ? xy : z;
    }
    void set_planes(float wider, const float* from);
};

}  // namespace limn::trace
