// The path tracer.
#pragma once

#include <cstdint>

#include "flat/scene.h"
#include "limn/core/ray.h"
#include "limn/render/settings.h"
#include "render/direct_light.h"
#include "render/media.h"
#include "render/sampler.h"

namespace limn::tracing {

// Estimates the radiance that arrives along camera rays. One for each thread: it counts rays and keeps scratch memory.
class PathTracer {
public:
    PathTracer(const flat::Scene& scene, int max_depth, Estimator estimator)
        : scene_(scene),
          max_depth_(max_depth),
          sample_lights_(estimator == Estimator::path && !scene.lights.empty()),
          roulette_(estimator == Estimator::path || max_depth == kUnlimitedDepth) {}

    // One sample of the radiance along `ray`, unbiased but for paths longer than max_depth segments.
    Color radiance(Ray ray, Sampler& sampler);

    std::uint64_t rays() const { return rays_; }
    // Of these, those that could not be traced.
    std::uint64_t unusable_rays() const { return unusable_rays_; }

private:
    struct Vertex;
    enum class End { vertex, background, lost };
    bool count(const Ray& ray);
    Color direct_light(const Vertex& vertex, const Receiver& receiver, double time, const LightNumbers& numbers);
    End advance(Ray ray, Vertex& vertex, Sampler& sampler);

    const flat::Scene& scene_;
    const int max_depth_;
    const bool sample_lights_;
    const bool roulette_;  // the naive estimator, which is a check, does without where a limit ends its paths
    std::uint64_t rays_ = 0, unusable_rays_ = 0;
    MediaAlongRay media_;
};

}  // namespace limn::tracing
