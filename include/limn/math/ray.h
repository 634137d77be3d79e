/// \file
/// Rays.
#pragma once

#include "limn/math/math.h"
#include "limn/math/vec.h"

namespace limn {

struct RayFrame;  // internal

/// A ray: the points origin + t direction with t in the half-open interval (t_min, t_max]. The direction need not have
/// unit length; t is in units of the direction.
struct Ray {
    Point3 origin;             ///< finite
    Vec3 direction;            ///< finite and not zero, of any length
    double t_min = 0;          ///< excluded: a hit at t_min is not found
    double t_max = kInfinity;  ///< included: a hit at t_max is found
    /// The time at which the ray sees moving objects. They move from time 0 to time 1. A time below 0 counts as 0, and
    /// a time above 1 counts as 1.
    double time = 0;
    /// Internal data of a ray inside an instance; null in a ray that you make. The origin and the direction in the
    /// space of an instance are rounded. The frame describes the exact ray, so that limn's shapes can decide exactly
    /// whether they are hit.
    ///
    /// - The pointer is valid during the call of Hittable::hit that receives the ray.
    /// - A copy of the ray may have another t_min or t_max.
    /// - If a copy has another origin or direction, shapes ignore its frame and use its own numbers.
    /// - Queries of a CompiledScene ignore the frame.
    const RayFrame* frame = nullptr;

    /// Returns the point at t, rounded.
    constexpr Point3 at(double t) const { return origin + t * direction; }
};

/// Returns true if the ray can be traced: origin, direction and time are finite, the direction is not zero,
/// t_min <= t_max, and t_min < +infinity. In every query an unusable ray misses.
inline bool is_usable(const Ray& r) {
    return is_finite(r.origin) && is_finite(r.direction) && !(r.direction == Vec3{}) && r.t_min <= r.t_max &&
           r.t_min < kInfinity && std::isfinite(r.time);
}

}  // namespace limn
