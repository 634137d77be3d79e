// The path tracer.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bsdf/lobe.h"
#include "flat/scene.h"
#include "limn/math/ray.h"
#include "query/surface_at.h"
#include "render/holes.h"
#include "render/media.h"
#include "render/path_settings.h"
#include "render/sampler.h"
#include "shading/lights.h"
#include "shading/stages.h"
#include "trace/traverse.h"

namespace limn::transport {

// One sample of the radiance along a camera ray.
struct Path {
    Sampler sampler;
    Color radiance{};  // the result
    double clear = 0;  // how much light of a background that is left out it would have brought
};

// Estimates the radiance that arrives along camera rays, of a batch of paths at a time: all go one segment on before
// any goes two, in stages: nearest hits, media, surfaces, emission, then for the vertices of each lobe light from lamps
// and scattering, and at last shadow rays. What a path does depends on nothing but its own ray and numbers. One for
// each thread: it counts rays and keeps its memory.
class PathTracer {
public:
    // \param transparent whether the camera does not see the background
    PathTracer(const flat::Scene& scene, int max_depth, Estimator estimator, bool transparent = false);

    // Where the camera rays of the next paths go: origin, direction and time in the first rows.
    shade::Segments& camera_rays() { return *next_; }
    // Unbiased but for paths longer than max_depth segments. \pre kBatch at most, one kind of sampler
    void trace(std::span<Path> paths);
    // Of one path.
    Color radiance(const Ray& ray, const Sampler& sampler) {
        camera_rays().set_ray(0, ray);
        Path path{sampler};
        trace({&path, 1});
        return path.radiance;
    }

    std::uint64_t rays() const { return rays_; }
    // Of these, those that could not be traced.
    std::uint64_t unusable_rays() const { return unusable_rays_; }

private:
    // Vertices of one lobe, where paths scatter or, on the way through media, where they ask for light alone.
    struct Queue {
        Queue(const bsdf::Lobe* its_lobe, bool alone) : lobe(its_lobe), for_light_alone(alone) {}

        const bsdf::Lobe* lobe;
        bool for_light_alone;
        shade::Paths paths;
        bsdf::Vertices vertices;
        sampling::Row light_numbers[3] = {};
        sampling::Row wants_light = {};  // how much more densely it was drawn for that than where paths scatter, or 0
        sampling::Row light_odds = {};   // how much more densely lights were sampled on the way to it
    };
    // Lights that were met by scattering, and could have been drawn.
    struct Emitters : shade::LastVertexRows<bsdf::kShaded> {
        std::size_t count = 0;
        std::uint32_t paths[bsdf::kShaded] = {};
        Color emission[bsdf::kShaded];
        sampling::Row time = {};
        lights::LightHits hits;
    };

    void begin(std::span<Path> paths);
    bool count(const Ray& ray);
    void count(const shade::RayCounts& counts);
    template <std::size_t n>
    void draw(const sampling::PathRows<n>& paths, std::size_t first, std::size_t count, Use use, std::size_t dimensions,
              sampling::Row* numbers);
    void draw_holes(std::size_t first);
    void draw_flights(std::size_t first);
    void find_hits();
    void find_vertex(std::size_t row);
    double want_light_on_the_way(std::size_t row, const FreeFlight& flown);
    void pass_boundary(std::size_t row, const Surface& boundary, const Color& throughput, double depth);
    void escape(std::size_t row, const Color& throughput);
    void add_distant_emission(std::size_t row, const Color& throughput);
    template <class Place>
    void add_emission(std::size_t row, const Color& emission, std::uint64_t primitive, const Place& place);
    void add_weighed_emission();
    void add_vertex(std::size_t row, const Surface& vertex, const Color& throughput, double light_odds = 0);
    Queue& queue_of(const bsdf::Lobe* lobe, bool for_light_alone);
    std::size_t push(Queue& queue, std::size_t row, const Surface& vertex, const Color& throughput);
    void shade(Queue& queue);
    void sample_lights(Queue& queue);
    void scatter(Queue& queue);
    void add_direct_light();

    const PathSettings settings_;
    const flat::Scene& scene_;
    const bool has_holes_;  // in surfaces: materials with an opacity
    std::uint64_t rays_ = 0, unusable_rays_ = 0;
    MediaAlongRay media_;
    Holes holes_;
    std::span<Path> paths_;
    std::unique_ptr<shade::Segments> now_, next_;
    std::vector<Ray> ray_list_;  // as they are traced
    std::vector<trace::Hit> hits_;
    query::SurfaceHit met_;  // of find_vertex alone; filled in place, so that what is not asked for costs nothing
    std::vector<Queue> queues_;
    Emitters emitters_;
    lights::LightSamples light_samples_;
    shade::ShadowRays shadows_;
    std::vector<std::uint8_t> occluded_;
};

}  // namespace limn::transport
