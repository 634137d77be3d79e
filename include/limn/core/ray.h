/// \file
/// Rays.
#pragma once

#include "limn/core/math.h"
#include "limn/core/vec.h"

namespace limn {

struct RayFrame;  // limn's own

/// The half-open segment origin + t direction, t in (t_min, t_max]. The direction need not have unit length; t is in
/// units of it. `time` is in shutter units, 0 to 1; finite times outside are clamped by whatever moves.
struct Ray {
    Point3 origin;             ///< finite
    Vec3 direction;            ///< of any finite length but zero
    double t_min = 0;          ///< open: a hit at t_min is none
    double t_max = kInfinity;  ///< closed: a hit at t_max is one
    double time = 0;           ///< in shutter units
    /// limn's own, null in a ray that you make. Inside instances it says what the rounded origin and direction stand
    /// for, so that decisions are exact. Valid during the call of hit() that receives it. A copy with another t_min or
    /// t_max keeps it. One with another origin or direction is another ray, and taken as it is. Queries of a
    /// CompiledScene take every ray as it is.
    const RayFrame* frame = nullptr;

    /// The point at t, rounded.
    constexpr Point3 at(double t) const { return origin + t * direction; }
};

/// Whether a ray can be traced: finite origin, direction and time, a direction that is not zero, no NaN, t_min <=
/// t_max, t_min below +infinity. In every query an unusable ray misses.
inline bool is_usable(const Ray& r) {
    return is_finite(r.origin) && is_finite(r.direction) && !(r.direction == Vec3{}) && r.t_min <= r.t_max &&
           r.t_min < kInfinity && std::isfinite(r.time);
}

}  // namespace limn
