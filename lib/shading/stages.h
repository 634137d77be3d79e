// What all vertices have in common, whatever their lobe: how batches of paths and shadow rays leave them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bsdf/lobe.h"
#include "limn/math/ray.h"
#include "shading/lights.h"

namespace limn::shade {

using sampling::kBatch, sampling::kShaded, sampling::kSlack, sampling::Row, sampling::Rows3;

// The vertices where n segments begin, as multiple importance sampling must know them.
template <std::size_t n>
struct LastVertexRows {
    sampling::Rows3Of<n> receiver, receiver_normal;  // the vertex as lights saw it: see lights::Receivers
    double scatter_pdf[n] = {};  // of the direction; 0: specular or from the camera, no light sampling competes
    double light_odds[n] = {};   // how much more densely the vertex was drawn for lights than for scattering

    static constexpr void each_column(auto& a, auto& b, const auto& f) {
        f(a.receiver, b.receiver);
        f(a.receiver_normal, b.receiver_normal);
        f(a.scatter_pdf, b.scatter_pdf);
        f(a.light_odds, b.light_odds);
    }
};

// n paths at the beginning of a segment.
template <std::size_t n>
struct SegmentRows : sampling::PathRows<n>, LastVertexRows<n> {
    sampling::Rows3Of<n> throughput, origin, direction;
    double depth[n] = {};   // optical, in scattering, to where media scatter the path
    double choose[n] = {};  // the medium that does
    double hole[n] = {};    // uniform: whether surfaces with an opacity stop the path

    static constexpr void each_column(auto& a, auto& b, const auto& f) {
        sampling::PathRows<n>::each_column(a, b, f);
        LastVertexRows<n>::each_column(a, b, f);
        f(a.throughput, b.throughput);
        f(a.origin, b.origin);
        f(a.direction, b.direction);
        f(a.depth, b.depth);
        f(a.choose, b.choose);
        f(a.hole, b.hole);
    }
};

// The segments that are traced next.
struct Segments : SegmentRows<kBatch + kSlack> {
    std::size_t count = 0;

    Ray ray(std::size_t i) const { return {origin.get<Point3>(i), direction.get<Vec3>(i), 0, kInfinity, time[i]}; }
    void set_ray(std::size_t i, const Ray& ray) {
        origin.set(i, ray.origin);
        direction.set(i, ray.direction);
        time[i] = ray.time;
    }
};

struct ShadowRays {
    static constexpr std::size_t kRows = 2 * kBatch + kSlack;

    std::size_t count = 0;
    std::uint32_t path[kRows] = {};
    double time[kRows] = {};
    double end[kRows] = {};  // t_max
    sampling::Rows3Of<kRows> origin, direction;
    sampling::Rows3Of<kRows> light;  // that arrives if nothing is in the way
};

// Of rays that began. Those that are not usable (limn/math/ray.h) carry no light: a shape or material of extreme
// numbers can spoil one.
struct RayCounts {
    std::size_t all = 0, unusable = 0;
};

// Paths at their next vertices.
struct Paths : sampling::PathRows<kShaded> {
    Rows3 throughput;
};

// Adds a ray for each vertex at which light arrives: throughput f |cos| emission / pdf, weighed against finding it by
// scattering. \param vertices with the value for the direction of each light
// \param odds how much more densely a vertex was drawn than where paths scatter; 0: it wants no light
RayCounts add_shadow_rays(const Paths& paths, const bsdf::Vertices& vertices, const lights::LightSamples& samples,
                          const Rows3& emission, const Row& odds, ShadowRays& shadows);

// Russian roulette: from vertex `start` on a path goes on with `factor` times its throughput as probability, at most
// `largest`.
struct Roulette {
    std::uint32_t start;
    double factor, largest;
};

// Multiplies the throughput by what the lobe has sampled. With which probability each path goes on; whether that is
// under 1 anywhere.
bool scatter(const Roulette& roulette, const bsdf::Vertices& vertices, Paths& paths, Row& survival);

// Adds the next segments of those whose number is under their survival.
// \param odds how much more densely each vertex was drawn for lights than for scattering
RayCounts add_segments(const Paths& paths, const bsdf::Vertices& vertices, bool one_sided, const Row& survival,
                       const Row& numbers, const Row& odds, Segments& next);

// The weight of light that was found by scattering, against finding it by sampling lights.
void weigh_emission(std::size_t count, const Row& scatter_pdf, const Row& light_pdf, Row& weight);

}  // namespace limn::shade
