// What the tests of all materials share.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "catch.h"
#include "limn/math/warp.h"
#include "limn/scene/material/material.h"
#include "limn/scene/material/roughness.h"
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
    int draws;
    Color mean_weight;
    double deviation = 0;  ///< of the mean weight, in green: one sigma
    double absorbed = 0;
    double worst_ratio = 0;  ///< largest relative difference of weight and value / pdf, and of the two pdfs
    double p_value, integral;

    /// \param axis, max_angle the cone that holds all of the lobe
    Lobe(const Material& material, const Surface& s, const Vec3& out, const Vec3& axis, double max_angle = kPi)
        : Lobe(material, s, out, DirectionHistogram(axis, max_angle), kDraws) {}

    Lobe(const Material& material, const Surface& s, const Vec3& out, const DirectionHistogram& cells, int number)
        : histogram(cells), draws(number) {
        std::mt19937_64 random(64);
        double squares = 0;
        for (int i = 0; i < draws; ++i) {
            const std::optional<ScatterSample> sample = material.sample(s, out, random3(random));
            histogram.add(sample ? std::optional(sample->direction) : std::nullopt);
            if (!sample) {
                absorbed += 1.0 / draws;
                continue;
            }
            mean_weight += sample->weight / draws;
            squares += sample->weight.g * sample->weight.g / draws;
            const ScatterValue value = material.value(s, out, sample->direction);
            worst_ratio = std::max({worst_ratio, std::abs(value.pdf / sample->pdf - 1),
                                    std::abs(value.value.g / value.pdf / sample->weight.g - 1)});
        }
        deviation = std::sqrt(std::max(squares - mean_weight.g * mean_weight.g, 0.0) / draws);
        p_value = histogram.p_value([&](const Vec3& in) { return material.value(s, out, in).pdf; });
        integral = histogram.integral([&](const Vec3& in) { return material.value(s, out, in).value.g; });
    }
};

/// The grid over which samples of every lobe are compared with its density: steep, slanting and grazing, smooth to
/// rough, and brushed where a material can be.
///@{
inline constexpr double kGridDegrees[] = {10, 50, 85};
inline constexpr double kGridRoughness[] = {0.3, 0.6, 1.0};
inline const Roughness kGridBrushed[] = {{0.3}, {0.6}, {1.0}, {0.3, 0.8}, {0.9, 0.4}};
///@}

/// A slanting surface with the tangents that a brushed one needs, and directions over it.
inline Surface grid_surface(bool front_face = true) {
    Surface s = surface({1, -2, 3});
    s.dp_du = {2, 0, 1}, s.dp_dv = {-1, 1, 0}, s.front_face = front_face;
    return s;
}
inline Vec3 over(const Surface& s, double degrees, double azimuth = 1) {
    const double sine = std::sin(radians(degrees));
    return Frame(Vec3(s.normal))
        .to_world({sine * std::cos(azimuth), sine * std::sin(azimuth), std::cos(radians(degrees))});
}

/// Samples of what leaves on the side of `axis`, most of it around `peak`. The 50'000 draws in 240 cells of each point
/// of the grid show a density that is wrong by 5 % (rms) nine times in ten; a long run has ten times as many.
inline void check_samples(const Material& material, const Surface& s, const Vec3& out, const Vec3& axis,
                          const Vec3& peak) {
    const Lobe lobe(material, s, out, DirectionHistogram(axis, kPi / 2, peak), kDraws / 20);
    CHECK(lobe.p_value > kSamplerLevel);
    const double quadrature = lobe.histogram.quadrature_error() * lobe.integral;
    CHECK(std::abs(lobe.mean_weight.g - lobe.integral) < 4.5 * lobe.deviation + quadrature);
    CHECK(lobe.worst_ratio < 1e-9);
}

/// From all angles of the grid, of a material that reflects.
inline void check_samples(const Material& material) {
    const Surface s = grid_surface();
    for (const double degrees : kGridDegrees) {
        CAPTURE(degrees);
        check_samples(material, s, over(s, degrees), Vec3(s.normal), over(s, degrees, 1 + kPi));
    }
}

}  // namespace limn::test
