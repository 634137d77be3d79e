// What the intersections share: a decision is first tried in double, with a proven bound on the error; what the bound
// leaves undecided the exact fallback decides (exact.h). So no decision depends on how well a filter does. The t that
// is reported does, by rounding: it is the filter's where that decides and is accurate, else the exact fallback's,
// wherever the shape is met.
#pragma once

#include <cmath>

#include "limn/core/math.h"

namespace limn {

// The largest errors that a filter may report a hit with: of t relative, of u and v absolute.
inline constexpr double kAccurate = 0x1p-32, kAccurateWeight = 0x1p-26;

// Where hits may lie: t in (t_min, t_max], finite. The t that is reported decides, so that the interval and the
// order of hits are judged by the number that the caller sees.
struct Search {
    double t_min, t_max;

    bool contains(double t) const { return t > t_min && t <= t_max && t < kInfinity; }
};

// A hit of a shape; u and v of those that have them.
struct PlanarHit {
    double t, u, v;
};

inline double larger(double a, double b) { return a > b ? a : b; }
inline double smaller(double a, double b) { return a < b ? a : b; }
inline double largest_magnitude(double a, double b, double c) {
    return larger(std::abs(a), larger(std::abs(b), std::abs(c)));
}

}  // namespace limn
