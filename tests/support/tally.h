// Counts over many rays with one assertion at the end, and the first fault in hexadecimal so that it can be repeated.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "limn/math/ray.h"

namespace limn::test {

inline std::string describe(const Ray& r) {
    char text[512];
    std::snprintf(text, sizeof text, "Ray{{%a, %a, %a}, {%a, %a, %a}, %a, %a, %a}", r.origin.x, r.origin.y, r.origin.z,
                  r.direction.x, r.direction.y, r.direction.z, r.t_min, r.t_max, r.time);
    return text;
}

struct Tally {
    std::uint64_t rays = 0, judged = 0, hits = 0, wrong = 0;
    std::string first;

    void fault(const Ray& ray, const std::string& what) {
        if (wrong++ == 0) first = what + ": " + describe(ray);
    }
};

/// Whether a hit lies at the ray's very origin, so near that its t is nothing but the rounding of the coordinates:
/// which of several such surfaces comes first is then open.
inline bool is_at_origin(const Ray& ray, double t) {
    const double largest = std::max({std::abs(ray.origin.x), std::abs(ray.origin.y), std::abs(ray.origin.z)});
    return std::abs(t) * length(ray.direction) <= 1e-13 * largest;
}

}  // namespace limn::test
