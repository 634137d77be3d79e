// The path tracer.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bsdf/lobe.h"
#include "flat/scene.h"
#include "lights/lights.h"
#include "limn/core/ray.h"
#include "limn/render/settings.h"
#include "query/surface_at.h"
#include "render/equiangular.h"
#include "render/media.h"
#include "render/sampler.h"
#include "shade/leave.h"
#include "trace/traverse.h"

namespace limn::transport {

// One sample of the radiance along a camera ray.
struct Path {
    Sampler sampler;
    Ray ray{};
    Color radiance{};  // the result
};

// Estimates the radiance that arrives along camera rays, of many paths at a time: all go one segment on before any goes
// two, in stages: nearest hits, media, surfaces, emission, then for the vertices of each lobe light from lamps and
// scattering, and at last shadow rays. What a path does depends on nothing but its own ray and numbers. One for each
// thread: it counts rays and keeps its memory.
class PathTracer {
public:
    PathTracer(const flat::Scene& scene, int max_depth, Estimator estimator);

    // Unbiased but for paths longer than max_depth segments.
    void trace(std::span<Path> paths);
    // Of one path.
    Color radiance(const Ray& ray, const Sampler& sampler) {
        Path path{sampler, ray};
        trace({&path, 1});
        return path.radiance;
    }

    std::uint64_t rays() const { return rays_; }
    // Of these, those that could not be traced.
    std::uint64_t unusable_rays() const { return unusable_rays_; }

private:
    // Where a path stands at the beginning of a segment, but for the ray.
    struct State {
        int segment = 1;
        Color throughput{1, 1, 1};
        Point3 receiver;         // the vertex before, as lights saw it
        Vec3 receiver_normal;    //
        double scatter_pdf = 0;  // of the direction; 0: specular or from the camera, no light sampling competes
        double light_odds = 1;   // how much more densely the vertex before was drawn for lights than for scattering
        double depth = 0;        // optical, in scattering, to where media scatter the path
        double choose = 0;       // the medium that does
    };
    // Some of the paths, and a ray for each.
    struct Rays {
        std::vector<std::uint32_t> paths;
        std::vector<Ray> rays;

        void clear() { paths.clear(), rays.clear(); }
        void add(std::uint32_t path, const Ray& ray) { paths.push_back(path), rays.push_back(ray); }
    };
    // Vertices of one lobe, where paths scatter or, on the way through media, where they ask for light alone.
    struct Queue {
        Queue(const bsdf::Lobe* its_lobe, bool alone) : lobe(its_lobe), for_light_alone(alone) {}

        const bsdf::Lobe* lobe;
        bool for_light_alone;
        bsdf::Vertices vertices;
        std::array<std::uint32_t, bsdf::kShaded> paths{};
        std::array<bool, bsdf::kShaded> wants_light{};
        sampling::Row time = {}, light_numbers[3] = {};
        sampling::Row light_odds = {};
        std::array<Color, bsdf::kShaded> throughput;  // there
    };
    // Lights that were met by scattering, and could have been drawn.
    struct Emitters {
        std::size_t count = 0;
        std::array<std::uint32_t, bsdf::kShaded> paths{};
        std::array<Color, bsdf::kShaded> emission;
        sampling::Rows3 receiver, receiver_normal;
        sampling::Row time = {}, scatter_pdf = {}, light_odds = {};
        lights::LightHits hits;
    };

    bool count(const Ray& ray);
    void begin_segment(std::uint32_t path, const Ray& ray);
    void find_hits();
    void find_vertex(std::uint32_t path, const Ray& ray, const trace::Hit& hit);
    double want_light_on_the_way(std::uint32_t path, const Ray& ray, const FreeFlight& flown);
    void add_emission(std::uint32_t path, const Surface& vertex, std::uint64_t primitive, double time);
    void add_weighed_emission();
    void add_vertex(std::uint32_t path, const Ray& ray, const Surface& vertex, double light_odds = 0);
    Queue& queue_of(const bsdf::Lobe* lobe, bool for_light_alone);
    std::size_t push(Queue& queue, std::uint32_t path, const Ray& ray, const Surface& vertex, const Color& throughput);
    void shade(Queue& queue);
    void draw(Queue& queue, Use use, std::size_t n, sampling::Row* numbers);
    void sample_lights(Queue& queue);
    void scatter(Queue& queue);
    double survival(const State& state) const;
    void add_shadow(std::uint32_t path, const Color& light, const Ray& ray);
    void add_direct_light();

    const flat::Scene& scene_;
    const int max_depth_;
    const bool sample_lights_;
    const LightsAsPivot pivot_;
    const bool roulette_;  // the naive estimator, which is a check, does without where a limit ends its paths
    std::uint64_t rays_ = 0, unusable_rays_ = 0;
    MediaAlongRay media_;
    std::span<Path> paths_;
    std::vector<State> states_;  // of each
    Rays now_, next_;            // of those that go on
    std::vector<trace::Hit> hits_;
    query::SurfaceHit met_;
    std::vector<Queue> queues_;
    Emitters emitters_;
    lights::LightSamples light_samples_;
    shade::ShadowRays shadow_rows_;
    Rays shadows_;
    std::vector<Color> arriving_;  // light, if nothing is in the way of the shadow ray
    std::vector<std::uint8_t> occluded_;
    sampling::SobolLanes samplers_;
};

}  // namespace limn::transport
