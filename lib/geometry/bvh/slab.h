// The closed ray/box test. SlabRay::meets() returns true for every box that contains a hit:
// - Every box is widened a little. This also covers the rounding of the test itself (Ize, Robust BVH Ray Traversal,
//   JCGT 2(2), 2013).
// - If the ray is in a face of the box, 0 * infinity gives a NaN. A NaN doesn't change the interval.
// The test never computes lo * inv - o * inv, because the rounding error of that form isn't bounded.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "limn/math/box.h"
#include "limn/math/ray.h"

namespace limn::accel {

// The width of the slack, relative to |origin| + extent. Both the boxes and the interval [t_min, t_max] are widened by
// it:
// - The interval, because traversal compares the t at which a ray enters a box with the t of hits. The t of a hit has a
//   relative error of up to 2^-32 (filter.h). That is up to 2^-32 (|origin| + extent) in units of length. kSlack is
//   four times as large.
// - The boxes, because the moved origin, the difference, the reciprocal and the product are rounded. This error of t is
//   at most 4 * 2^-53 (|origin| + extent) * inverse.
// The price is a needless visit now and then.
inline constexpr double kSlack = 0x1p-30;

// A ray prepared for the test. If the ray is in the space of an instance, boxes and interval are also widened by its
// own rounding error. If its direction may be wrong by more than an eighth of its length, every box counts as hit.
struct SlabRay {
    double origin_near[3], origin_far[3];  // the origin, moved to widen the near and far planes of boxes
    double inverse[3];                     // reciprocals of the direction
    bool negative[3];                      // signs of the direction
    double slack;                          // extends the interval at both ends; a length of t * scale
    double t_min;                          // lower end of the interval of t * scale, with the slack
    double scale = 1;                      // a power of two that keeps `inverse` in range

    // `extent` is the largest finite coordinate of the boxes that will be tested. `origin_error` and `direction_error`
    // bound the rounding errors of the ray's origin and direction along each axis.
    SlabRay(const Ray& ray, double extent, double origin_error = 0, double direction_error = 0) {
        // Scale up a very short direction.
        Vec3 direction = ray.direction;
        double length = max_abs(direction);
        if (length < 0x1p-900) {
            scale = 0x1p-900;
            direction = 0x1p900 * direction;
            direction_error *= 0x1p900;
            length *= 0x1p900;
        }
        // Widen the interval.
        const double reach = max_abs(ray.origin) + extent;
        const double wider = kSlack * reach + 2 * (origin_error + direction_error / length * reach) + 0x1p-1000;
        slack = wider / length;
        t_min = ray.t_min * scale - slack;
        // Widen the boxes by moving the origin. A direction component below 2^-1000 counts as 0, because it moves the
        // ray by less than `wider`.
        for (std::size_t a = 0; a < 3; ++a) {
            const double along = std::abs(direction[a]) < 0x1p-1000 ? std::copysign(0.0, direction[a]) : direction[a];
            negative[a] = std::signbit(along);
            origin_near[a] = ray.origin[a] + (negative[a] ? -wider : wider);
            origin_far[a] = ray.origin[a] - (negative[a] ? -wider : wider);
            inverse[a] = 1 / along;
        }
        if (reach < 0x1p1000 && wider < 0x1p1000 && direction_error < 0x1p-3 * length) return;
        // If the direction is too uncertain or a difference could overflow, hit every box but the empty one, whose
        // planes are infinite.
        slack = kInfinity;
        t_min = -kInfinity;
        for (std::size_t a = 0; a < 3; ++a) {
            origin_near[a] = std::numeric_limits<double>::max();
            origin_far[a] = -origin_near[a];
            inverse[a] = 1;
            negative[a] = false;
        }
    }

    // Returns true if a box that the ray enters at `near` can't contain a hit up to t_max.
    bool is_beyond(double near, double t_max) const { return near > t_max * scale + slack; }

    // Returns true if the ray intersects the box from `lower` to `upper`, in float or double, within [t_min, t_max].
    // Writes the t * scale at which the ray enters the box, at least t_min, to `near`, hit or not.
    template <class Real>
    bool meets(const Real* lower, const Real* upper, double t_max, double& near) const {
        double enter = t_min, leave = t_max * scale + slack;
        for (std::size_t a = 0; a < 3; ++a) {
            const double to_near =
                (static_cast<double>(negative[a] ? upper[a] : lower[a]) - origin_near[a]) * inverse[a];
            const double to_far = (static_cast<double>(negative[a] ? lower[a] : upper[a]) - origin_far[a]) * inverse[a];
            enter = to_near > enter ? to_near : enter;
            leave = to_far < leave ? to_far : leave;
        }
        near = enter;
        return enter <= leave;
    }

    bool meets(const Box& b, double t_max, double& near) const {
        const double lower[3] = {b.lower.x, b.lower.y, b.lower.z}, upper[3] = {b.upper.x, b.upper.y, b.upper.z};
        return meets(lower, upper, t_max, near);
    }
};

// Returns the largest magnitude of a finite coordinate of the box, or 0.
inline double finite_extent(const Box& b) {
    double extent = 0;
    for (std::size_t a = 0; a < 3; ++a)
        for (const double x : {b.lower[a], b.upper[a]})
            if (std::isfinite(x)) extent = std::max(extent, std::abs(x));
    return extent;
}

}  // namespace limn::accel
