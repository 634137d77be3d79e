// The closed ray/box test. For any box that contains a hit, meets() is true: boxes count as a little larger, which
// covers the test's own rounding too (Ize, Robust BVH Ray Traversal, JCGT 2(2), 2013), and a NaN, which arises where
// the ray lies in a face (0 * infinity), leaves the interval as it is. It never uses lo * inv - o * inv, whose rounding
// is not bounded.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "limn/core/box.h"
#include "limn/core/ray.h"

namespace limn::accel {

// Traversal compares where a ray enters a box with the t of hits, and those may be off by 2^-32 of themselves
// (filter.h), so by as much of the largest coordinate, in units of t. So t_min and t_max count as wider by four times
// that; and boxes, against what moved origin, difference, reciprocal and product lose in a slab: at most 4 * 2^-53 of
// (|origin| + extent) * inverse. It only costs a visit now and then. A ray inside an instance counts as wider by what
// its own numbers are off; where its direction may be off by more than an eighth, nothing is known of where it goes.
inline constexpr double kSlack = 0x1p-30;

struct SlabRay {
    double origin_near[3], origin_far[3];  // moved so that boxes seem larger
    double inverse[3];
    bool negative[3];
    double slack;
    double t_min;
    double scale = 1;  // of t: a power of two that keeps `inverse` in range

    // `extent`: the largest finite coordinate of the boxes to come. The ray may be the rounded image of another: its
    // origin off by origin_error along each axis, its direction by direction_error.
    SlabRay(const Ray& ray, double extent, double origin_error = 0, double direction_error = 0) {
        Vec3 direction = ray.direction;
        double length = max_abs(direction);
        if (length < 0x1p-900) {
            scale = 0x1p-900;
            direction = 0x1p900 * direction;
            direction_error *= 0x1p900;
            length *= 0x1p900;
        }
        const double reach = max_abs(ray.origin) + extent;
        const double wider = kSlack * reach + 2 * (origin_error + direction_error / length * reach) + 0x1p-1000;
        slack = wider / length;
        t_min = ray.t_min * scale - slack;
        for (std::size_t a = 0; a < 3; ++a) {
            // A direction that hardly moves along an axis stays within what `wider` allows.
            const double along = std::abs(direction[a]) < 0x1p-1000 ? std::copysign(0.0, direction[a]) : direction[a];
            negative[a] = std::signbit(along);
            origin_near[a] = ray.origin[a] + (negative[a] ? -wider : wider);
            origin_far[a] = ray.origin[a] - (negative[a] ? -wider : wider);
            inverse[a] = 1 / along;
        }
        if (reach < 0x1p1000 && wider < 0x1p1000 && direction_error < 0x1p-3 * length) return;
        // Nothing is known of where the ray goes, or differences could overflow: every box is met but the empty one,
        // whose sides are infinite.
        slack = kInfinity, t_min = -kInfinity;
        for (std::size_t a = 0; a < 3; ++a) {
            origin_near[a] = std::numeric_limits<double>::max(), origin_far[a] = -origin_near[a];
            inverse[a] = 1, negative[a] = false;
        }
    }

    // Whether a box entered at `near` cannot hold a hit up to t_max.
    bool is_beyond(double near, double t_max) const { return near > t_max * scale + slack; }

    // The box from lower to upper, in float or double; `near` gets where the ray enters it, or t_min, in t times scale.
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

// The largest finite magnitude of a coordinate of the box.
inline double finite_extent(const Box& b) {
    double extent = 0;
    for (std::size_t a = 0; a < 3; ++a)
        for (const double x : {b.lower[a], b.upper[a]})
            if (std::isfinite(x)) extent = std::max(extent, std::abs(x));
    return extent;
}

}  // namespace limn::accel
