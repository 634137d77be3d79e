/// \file
#pragma once

#include "limn/core/math.h"
#include "limn/core/vec.h"

namespace limn {

/// The half-open segment origin + t direction, t in (t_min, t_max]. The direction need not have unit length; t is in
/// units of it. `time` is in shutter units, 0 to 1; times outside are clamped by whatever moves.
struct Ray {
    Point3 origin;
    Vec3 direction;
    double t_min = 0;
    double t_max = kInfinity;
    double time = 0;

    constexpr Point3 at(double t) const { return origin + t * direction; }
};

/// Whether a ray can be traced: finite origin and direction, a direction that is not zero, no NaN, t_min <= t_max,
/// t_min below +infinity. Every query answers an unusable ray with a miss.
inline bool is_usable(const Ray& r) {
    return is_finite(r.origin) && is_finite(r.direction) && !(r.direction == Vec3{}) && r.t_min <= r.t_max &&
           r.t_min < kInfinity && std::isfinite(r.time);
}

}  // namespace limn
