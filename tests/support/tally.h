// Counts over many rays with one assertion at the end, and the first fault in hexadecimal so that it can be repeated.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include "limn/core/ray.h"

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

}  // namespace limn::test
