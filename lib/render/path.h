// The path tracer.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "flat/scene.h"
#include "limn/core/ray.h"
#include "limn/render/settings.h"
#include "query/surface_at.h"
#include "render/direct_light.h"
#include "render/equiangular.h"
#include "render/media.h"
#include "render/sampler.h"
#include "shade/lobes.h"
#include "trace/traverse.h"

namespace limn::transport {

// One sample of the radiance along a camera ray.
struct Path {
    Sampler sampler;
    Ray ray{};
    Color radiance{};  // the answer
};

// Estimates the radiance that arrives along camera rays, of many paths at a time: all go one segment on before any goes
// two, so that their rays are traced together, and vertices on the commonest materials are shaded together. What a path
// does depends on nothing but its own ray and numbers. One for each thread: it counts rays and keeps its memory.
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
        Path path{sampler, ray};
        trace({&path, 1});
        return path.radiance;
    }

    std::uint64_t rays() const { return rays_; }
    // Of these, those that could not be traced.
    std::uint64_t unusable_rays() const { return unusable_rays_; }

private:
    // Where a path stands at the beginning of a segment, but for the ray.
    struct Head {
        int segment = 1;
        Color throughput{1, 1, 1};
        Receiver previous{};     // the vertex before, as lights saw it
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
    // Whose vertices are shaded together.
    struct Company {
        std::array<std::uint32_t, sampling::kShaded> paths;
        std::array<bool, sampling::kShaded> ask_lights;
        sampling::SobolLanes samplers;
    };
    // Vertices of one lobe.
    struct Group : Company {
        shade::VertexLanes lanes;
        std::array<double, sampling::kShaded> times;
        std::array<flat::Light, sampling::kShaded> lights;  // those that are not kept anywhere
    };
    // Vertices on all other materials.
    struct Others : Company {
        std::size_t count = 0;
        std::array<query::SurfaceHit, sampling::kShaded> hits;
        std::array<Ray, sampling::kShaded> rays;
        sampling::Lane light_numbers[3], numbers[3];
    };

    bool count(const Ray& ray);
    void begin(std::uint32_t path, const Ray& ray);
    void find_hits();
    void follow(std::uint32_t path, const Ray& ray, const trace::Hit& hit);
    double light_on_the_way(std::uint32_t path, const Ray& ray, const FreeFlight& flown);
    void add_emission(std::uint32_t path, const Surface& vertex, std::uint64_t primitive, double time);
    void shade(std::uint32_t path, const Ray& ray, const Surface& vertex, double light_odds = 0);
    double survival(const Head& head) const;
    void go_on(std::uint32_t path, double survival, double pdf, const Ray& ray);
    void add_shadow(std::uint32_t path, const Color& light, const Ray& ray);
    void add_direct_light();
    // In path_groups.cpp.
    query::SurfaceHit& next_vertex() { return others_.hits[others_.count]; }  // where the next one is filled in
    void gather_other(std::uint32_t path, const Ray& ray, bool ask_lights);
    void gather(std::uint32_t path, const Ray& ray, shade::Lobe lobe, const Surface& vertex, bool ask_lights);
    void shade_group(shade::Lobe lobe);
    void sample_lights(shade::Lobe lobe);
    template <std::size_t n>
    void draw(Company& company, std::size_t count, Use use, sampling::Lane* numbers);
    void shade_others();
    void shade_other(std::size_t i);
    Group& group_of(shade::Lobe lobe) { return groups_[static_cast<std::size_t>(lobe)]; }

    const flat::Scene& scene_;
    const int max_depth_;
    const bool sample_lights_;
    const LightsAsPivot pivot_;
    const bool roulette_;  // the naive estimator, which is a check, does without where a limit ends its paths
    std::uint64_t rays_ = 0, unusable_rays_ = 0;
    MediaAlongRay media_;
    std::span<Path> paths_;
    std::vector<Head> heads_;  // of each
    Rays now_, next_;          // of those that go on
    std::vector<trace::Hit> hits_;
    std::array<Group, std::size(shade::kLobes)> groups_;
    Others others_;
    Rays shadows_;
    std::vector<Color> arriving_;  // light, if nothing is in the way of the shadow ray
    std::vector<std::uint8_t> occluded_;
};

}  // namespace limn::transport
