// Definitions that all intersections share.
//
// A filter computes in double, with a proven bound on its error, and decides if it can. Otherwise the exact fallback
// decides (exact.h). Therefore decisions do not depend on the quality of the filters. The rounding of the reported t
// does depend on it: the t is computed by the filter if the filter decides and is accurate, else by the exact fallback.
#pragma once

#include <cmath>

#include "limn/math/math.h"

namespace limn {

// The largest relative error of t, and the largest absolute error of u and v, with which a filter may report a hit.
inline constexpr double kAccurate = 0x1p-32, kAccurateWeight = 0x1p-26;

// The interval in which a hit is searched: t in (t_min, t_max], and finite. A hit is within it if its reported t is,
// which is rounded. The caller therefore sees no t outside the interval. The nearest hit is the one with the least
// reported t.
struct Search {
    double t_min, t_max;

    bool contains(double t) const { return t > t_min && t <= t_max && t < kInfinity; }
};

// A hit. u and v are 0 for shapes without such coordinates.
struct PlanarHit {
    double t, u, v;
};

inline double larger(double a, double b) { return a > b ? a : b; }
inline double smaller(double a, double b) { return a < b ? a : b; }
inline double largest_magnitude(double a, double b, double c) {
    return larger(std::abs(a), larger(std::abs(b), std::abs(c)));
}

}  // namespace limn
