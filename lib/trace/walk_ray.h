// The form of a ray, in float, in which it walks through a BLAS.
#pragma once

#include <cstdint>
#include <limits>

#include "flat/scene.h"
#include "geometry/filter.h"
#include "geometry/ray_frame.h"

namespace limn::trace {

// A ray in float, with bounds on its rounding errors. A plane of a box at p is met at t = p * inverse + shift. The
// shift moves near planes back and far planes on, so that no box which holds a hit is missed.
//
// Proof. Let u = 2^-24. For an axis a let R_a = |origin_a| + extent, and let d be the direction.
//   - Planes, origin and direction are off by u each, the reciprocal by u more. A product and a sum with their two
//     operands are off by u each. So the t of a plane is off by at most 8 u R_a / |d_a|.
//   - The shift moves a plane by kWider R_a / |d_a|, kWider > 16 u. At least 8 u R_a / |d_a| are left.
//   - A hit in the box has |t d_a| <= R_a, because it is between the planes of each axis. So what is left is more than
//     the rounding of t_min and t_max to float, u t each, and than the error of a reported t, 2^-32 t.
//   - In an instance the origin is off by e and the direction by s besides. A near plane at p that the ray passes at t
//     has p - o <= t d_a + e + t s, if d_a > 0. So it is enough to move it by (e + t s) / |d_a|, even if d_a has the
//     wrong sign. Here t is at most R / |d_z| for the longest axis z, R the largest R_a.
//   - A direction along an axis that is shorter than kLeast is made as long as that. This is such an error of the
//     direction, with t s at most 2^-50 R.
// Ize, Robust BVH Ray Traversal, JCGT 2(2), 2013, has the idea.
struct WalkRay {
    alignas(16) float inverse[4], near_shift[4], far_shift[4];  // by axis
    alignas(16) float planar[16];                               // numbers of PlanarFloatRay
    alignas(16) float round[16];                                // numbers of SphereFloatRay
    std::uint32_t rows[3];                                      // the axes in the order of `planar`, the longest last
    unsigned octant;                                            // bit a is set if direction[a] is negative
    float t_min = 0;
    bool excludes_behind;  // true if t_min is not negative, so that hits behind the origin don't count

    static constexpr float kLeast = 0x1p-60f, kWider = 0x1.01p-20f;
    static constexpr float t_error = 0;  // as in AdaptedRay
};

// The same for any usable ray. Most rays don't need this: set_up() in walk_ray-inl.h makes their WalkRay. This one
//   - multiplies the direction by a power of two;
//   - counts t from another point if the ray starts far away;
//   - widens boxes by the errors of the ray.
struct AdaptedRay : WalkRay {
    float t_error = 0;                // error of upper() and lower() besides rounding
    double t_scale = 1, t_start = 0;  // the t of this ray is t * t_scale - t_start

    AdaptedRay(const RayFrame& frame, const flat::Blas& blas);

    // These return the t of this ray, rounded to float and moved up or down by t_error.
    float upper(double t) const {
        const double here = t * t_scale - t_start;
        return here < kLargest ? static_cast<float>(larger(here, -kLargest)) + t_error : kFloatInfinity;
    }
    float lower(double t) const {
        const double here = t * t_scale - t_start;
        return here > -kLargest ? static_cast<float>(smaller(here, kLargest)) - t_error : -kFloatInfinity;
    }

private:
    static constexpr double kLargest = 0x1p120;
    static constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();
    static constexpr double kFar = 8;  // extents from which on the origin is moved; it would not pay nearer

    // Sets `planar`, `round` and `rows`. The largest coordinate of `direction` is in [1, 2). The errors are those of
    // each coordinate.
    void set_leaves(const float* direction, const float* high, const float* low, const flat::Blas& blas,
                    float origin_error, float direction_error);
};

}  // namespace limn::trace
