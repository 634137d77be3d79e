// The closed ray/box test. For any box that contains a hit, met() answers true: the far side is moved out by two units
// in the last place (Ize, Robust BVH Ray Traversal, JCGT 2(2), 2013), and a NaN, which arises where the ray lies in a
// face (0 * infinity), leaves the interval as it is. It never uses lo * inv - o * inv, whose rounding is not bounded.
#pragma once

#include <cmath>

#include "limn/core/ray.h"

namespace limn::accel {

struct SlabRay {
    double origin[3];
    double inverse[3];
    bool negative[3];
    double t_min;

    explicit SlabRay(const Ray& ray) : t_min(ray.t_min) {
        for (std::size_t a = 0; a < 3; ++a) {
            origin[a] = ray.origin[a];
            inverse[a] = 1 / ray.direction[a];
            negative[a] = std::signbit(ray.direction[a]);
        }
    }

    // The box from lower to upper, in float or double; `near` gets where the ray enters it, or t_min. A double ulp is
    // 2^-52 relative at most; two of them for the two roundings that t carries beyond that of the inverse.
    template <class Real>
    bool meets(const Real* lower, const Real* upper, double t_max, double& near) const {
        double enter = t_min, leave = t_max;
        for (std::size_t a = 0; a < 3; ++a) {
            const double to_near = (static_cast<double>(negative[a] ? upper[a] : lower[a]) - origin[a]) * inverse[a];
            double to_far = (static_cast<double>(negative[a] ? lower[a] : upper[a]) - origin[a]) * inverse[a];
            to_far *= to_far > 0 ? 1 + 0x1p-51 : 1 - 0x1p-51;
            enter = to_near > enter ? to_near : enter;
            leave = to_far < leave ? to_far : leave;
        }
        near = enter;
        return enter <= leave;
    }
};

}  // namespace limn::accel
