// What the intersections share: a decision is first tried in double, with a proven bound on the error; what the bound
// leaves open the exact fallback decides (exact.h). So no decision depends on how well a filter does. The t that is
// reported does, by rounding: it is the filter's where that decides and is accurate, else the exact stage's, wherever
// the shape is met.
#pragma once

#include <cmath>

#include "limn/core/math.h"

namespace limn {

enum class Decision { miss, hit, undecided };

// A t as computed in double, and a bound on its error.
struct Approximate {
    double value;
    double error;
};

// What is good enough, where 2^-23 is promised: relative for t, absolute for u and v.
inline constexpr double kAccurate = 0x1p-32, kAccurateWeight = 0x1p-26;

// Whether the filter's t is the one to report. Not where the exact one may be a float32 that it just misses: such round
// numbers are what people put into t_min and t_max.
inline bool is_accurate(const Approximate& t) {
    const double round = static_cast<double>(static_cast<float>(t.value));
    const bool misses_round = t.value != round && std::abs(t.value - round) <= t.error;
    return t.error <= kAccurate * std::abs(t.value) && !misses_round;
}

// Where hits may lie: t in (t_min, t_max], finite. The t that is reported decides, so that the interval and the
// order of hits are judged by the number that the caller sees.
struct Search {
    double t_min, t_max;

    bool contains(double t) const { return t > t_min && t <= t_max && t < kInfinity; }
};

// `settled`: whether something else asks for the exact stage, whose t is the one to report then.
inline Decision in_search(const Approximate& t, const Search& s, bool settled = false) {
    if (t.value - t.error > s.t_max || t.value + t.error < s.t_min) return Decision::miss;
    if (settled || !is_accurate(t)) return Decision::undecided;
    return s.contains(t.value) ? Decision::hit : Decision::miss;
}

inline double larger(double a, double b) { return a > b ? a : b; }
inline double smaller(double a, double b) { return a < b ? a : b; }
inline double largest_magnitude(double a, double b, double c) {
    return larger(std::abs(a), larger(std::abs(b), std::abs(c)));
}

}  // namespace limn
