// Single rays through the path tracer.
#pragma once

#include "render/path.h"
#include "support/pictures.h"

namespace limn::test {

inline constexpr double kAlbedo = 0.6;

/// At the floor's origin from the side.
inline Ray at_floor(double time = 0) { return {.origin = {0, 0.4, 0.3}, .direction = {0, -0.4, -0.3}, .time = time}; }
inline const Vec3 kOut = normalize(Vec3{0, 0.4, 0.3});

/// The mean radiance of all channels over samples of one ray, and its standard error.
inline Measured along(const CompiledScene& scene, const Ray& ray, int depth, Estimator estimator,
                      std::uint64_t samples) {
    transport::PathTracer tracer(scene.flat(), depth, estimator);
    double sum = 0, squares = 0;
    for (std::uint64_t i = 0; i < samples; ++i) {
        transport::Sampler sampler(300, i, 0);
        const Color c = tracer.radiance(ray, sampler);
        const double value = (c.r + c.g + c.b) / 3;
        sum += value, squares += value * value;
    }
    const double n = static_cast<double>(samples), average = sum / n;
    return {average, std::sqrt(std::max(0.0, squares / n - average * average) / n)};
}

inline void check_both(const CompiledScene& scene, const Ray& ray, int depth, double truth,
                       std::uint64_t naive_samples) {
    INFO("by light sampling");
    check_mean(along(scene, ray, depth, Estimator::path, 50'000), truth, 8e-3);
    INFO("by scattering");
    check_mean(along(scene, ray, depth, Estimator::naive, naive_samples), truth, 2e-2);
}

}  // namespace limn::test
