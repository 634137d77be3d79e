// The path tracer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "flat/scene.h"
#include "kernels/traverse.h"
#include "limn/core/ray.h"
#include "limn/render/settings.h"
#include "render/direct_light.h"
#include "render/equiangular.h"
#include "render/media.h"
#include "render/sampler.h"

namespace limn::tracing {

// One sample of the radiance along a camera ray.
struct Path {
    Ray ray;
    Sampler sampler;
    Color radiance{};  // the answer
};

// Estimates the radiance that arrives along camera rays, of many paths at a time: all go one segment on before any goes
// two, so that their rays are traced together. What a path does depends on nothing but its own ray and numbers. One for
// each thread: it counts rays and keeps its memory.
class PathTracer {
public:
    PathTracer(const flat::Scene& scene, int max_depth, Estimator estimator)
        : scene_(scene),
          max_depth_(max_depth),
          sample_lights_(estimator == Estimator::path && !scene.lights.empty()),
          pivot_(scene),
          roulette_(estimator == Estimator::path || max_depth == kUnlimitedDepth) {}

    // Unbiased but for paths longer than max_depth segments.
    void trace(std::span<Path> paths);
    // Of one path.
    Color radiance(const Ray& ray, const Sampler& sampler) {
        Path path{ray, sampler};
        trace({&path, 1});
        return path.radiance;
    }

    std::uint64_t rays() const { return rays_; }
    // Of these, those that could not be traced.
    std::uint64_t unusable_rays() const { return unusable_rays_; }

private:
    // A segment that is yet to be followed.
    struct Head {
        Path* path = nullptr;
        Ray ray;
        int segment = 1;
        Color throughput{1, 1, 1};
        Receiver previous{};     // the vertex before, as lights saw it
        double scatter_pdf = 0;  // of the direction; 0: specular or from the camera, no light sampling competes
        double light_odds = 1;   // how much more densely the vertex before was drawn for lights than for scattering
        double depth = 0;        // optical, in scattering, to where media scatter the path
        double choose = 0;       // the medium that does
    };
    // Light that arrives if nothing is in the way.
    struct Shadow {
        Path* path;
        Color light;
    };
    struct Vertex;
    enum class End { vertex, passes, background };

    bool count(const Ray& ray);
    bool begin(Head& head);
    void find_hits();
    bool follow(Head& head, const kernels::Hit& hit);
    End meet(Head& head, const kernels::Hit& hit, Vertex& vertex);
    double light_on_the_way(const Head& head, const FreeFlight& flown);
    bool shade(Head& head, const Vertex& vertex);
    bool scatter(Head& head, const Vertex& vertex);
    void ask(const Head& head, const std::optional<DirectLight>& direct);
    void add_direct_light();

    const flat::Scene& scene_;
    const int max_depth_;
    const bool sample_lights_;
    const LightsAsPivot pivot_;
    const bool roulette_;  // the naive estimator, which is a check, does without where a limit ends its paths
    std::uint64_t rays_ = 0, unusable_rays_ = 0;
    MediaAlongRay media_;
    std::vector<Head> heads_;  // of the paths that go on
    std::vector<Shadow> shadows_;
    std::vector<Ray> traced_;
    std::vector<kernels::Hit> hits_;
    std::vector<std::uint8_t> occluded_;
};

}  // namespace limn::tracing
