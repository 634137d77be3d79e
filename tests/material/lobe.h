// What the tests of all materials share.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "limn/core/warp.h"
#include "limn/material/material.h"
#include "support/chi_square.h"

namespace limn::test {

inline constexpr double kAlmostOne = 1 - 0x1p-53;

inline Surface surface(const Vec3& normal, const Vec3& shading_normal) {
    Surface s;
    s.normal = Normal3(normalize(normal));
    s.shading_normal = Normal3(normalize(shading_normal));
    return s;
}
inline Surface surface(const Vec3& normal) { return surface(normal, normal); }

inline Random3 random3(std::mt19937_64& random) {
    const double x = uniform(random), y = uniform(random);
    return {x, y, uniform(random)};
}

inline Vec3 random_direction(std::mt19937_64& random) {
    const double u = uniform(random);
    return sample_uniform_sphere(u, uniform(random));
}

/// A direction on the normal's side.
inline Vec3 random_out(std::mt19937_64& random, const Surface& s) {
    const Vec3 w = random_direction(random);
    return dot(w, s.normal) < 0 ? -w : w;
}

inline bool is_unit(const Vec3& w) { return std::abs(length(w) - 1) <= gamma(32); }

/// What many samples at one surface, seen from one direction, amount to.
struct Lobe {
    DirectionHistogram histogram;
    Color mean_weight;
    double absorbed = 0;
    double worst_ratio = 0;  ///< largest relative difference of weight and value / pdf, and of the two pdfs
    double p_value, integral;

    /// \param axis, max_angle the cone that holds all of the lobe
    Lobe(const Material& material, const Surface& s, const Vec3& out, const Vec3& axis, double max_angle = kPi)
        : histogram(axis, max_angle) {
        std::mt19937_64 random(64);
        for (int i = 0; i < kDraws; ++i) {
            const std::optional<ScatterSample> sample = material.sample(s, out, random3(random));
            histogram.add(sample ? std::optional(sample->direction) : std::nullopt);
            if (!sample) {
                absorbed += 1.0 / kDraws;
                continue;
            }
            mean_weight += sample->weight / kDraws;
            const ScatterValue value = material.value(s, out, sample->direction);
            worst_ratio = std::max({worst_ratio, std::abs(value.pdf / sample->pdf - 1),
                                    std::abs(value.value.g / value.pdf / sample->weight.g - 1)});
        }
        p_value = histogram.p_value([&](const Vec3& in) { return material.value(s, out, in).pdf; });
        integral = histogram.integral([&](const Vec3& in) { return material.value(s, out, in).value.g; });
    }
};

}  // namespace limn::test
