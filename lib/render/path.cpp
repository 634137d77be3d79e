#include "render/path.h"

#include <algorithm>
#include <cmath>

#include "core/spawn.h"
#include "limn/scene/background.h"
#include "render/light_sampling.h"
#include "render/shading.h"
#include "render/surface_at.h"

namespace limn::tracing {

namespace {

// Russian roulette: from this vertex on a path goes on with this many times its throughput as probability. A path that
// may end in a sky brings all its light at once, and mostly soon, so that ending it costs more and saves less than
// where lamps are asked at each vertex. Measured by time times error against no roulette up to depth 10: under lamps
// (figures 12, 15, 16) 0.93, 0.73, 0.72, under skies (1, 11, 18) 0.93, 0.99, 0.98. Factors of 2 to 4 under lamps and 4
// to 10 under skies are within 5 %.
constexpr int kRouletteStart = 2;
constexpr double kSurvivalUnderLamps = 3, kSurvivalUnderSky = 6;
// Even a path that loses nothing must end some day where there is no limit; at 0.999 the variance that this adds is not
// measurable.
constexpr double kLargestSurvival = 0.999;

}  // namespace

// Where a path stands: on a surface, or in a medium (then `surface` has no normal and the phase function as material).
struct PathTracer::Vertex {
    Surface surface;
    Vec3 out;  // unit, back along the path
    std::uint64_t primitive = flat::RawHit::kMiss;
    double light_odds = 0;  // over 0: lights were asked along the segment, with this density over the free flight's
};

// Whether the ray can be traced. A shape or material of extreme numbers can spoil one; it carries no light.
bool PathTracer::count(const Ray& ray) {
    ++rays_;
    if (is_usable(ray)) return true;
    ++unusable_rays_;
    return false;
}

// The rendering equation by scattering: L = sum over path vertices of throughput * emission, where the throughput grows
// by f |cos| / pdf at each. With light sampling, every vertex also asks for the emission in one direction drawn towards
// a light. A direction that both ways could have found is counted by both, weighted so that the weights add to 1.
void PathTracer::trace(std::span<Path> paths) {
    heads_.clear();
    for (Path& path : paths) {
        path.radiance = {};
        heads_.push_back({.path = &path, .ray = path.ray});
        if (!begin(heads_.back())) heads_.pop_back();
    }
    while (!heads_.empty()) {
        find_hits();
        shadows_.clear();
        traced_.clear();
        std::size_t kept = 0;
        for (std::size_t i = 0; i < heads_.size(); ++i) {
            if (!follow(heads_[i], hits_[i])) continue;
            if (kept != i) heads_[kept] = heads_[i];
            ++kept;
        }
        heads_.resize(kept);
        add_direct_light();
    }
}

// A new segment.
bool PathTracer::begin(Head& head) {
    if (!flat::media_of(scene_).empty()) {
        head.path->sampler.seek(head.segment, Use::flight);
        const Uv random = head.path->sampler.next_2d();
        head.depth = -std::log1p(-random.u);  // 53 bits: up to 36.7 mean free paths
        head.choose = random.v;
    }
    return count(head.ray);
}

void PathTracer::find_hits() {
    traced_.clear();
    for (const Head& head : heads_) traced_.push_back(head.ray);
    hits_.resize(traced_.size());
    for (std::size_t i = 0; i < traced_.size(); i += kernels::kMostRays) {
        const std::size_t some = std::min(kernels::kMostRays, traced_.size() - i);
        kernels::closest_hits(scene_, std::span(traced_).subspan(i, some), &hits_[i]);
    }
}

// False if the path ends.
bool PathTracer::follow(Head& head, const kernels::Hit& hit) {
    Vertex vertex;
    switch (meet(head, hit, vertex)) {
        case End::vertex: return shade(head, vertex) && scatter(head, vertex);
        case End::passes: return count(head.ray);
        case End::background: break;
    }
    head.path->radiance +=
        head.throughput * Background{scene_.background_bottom, scene_.background_top}.radiance(head.ray.direction);
    return false;
}

// The next surface or scattering in a medium, or the background. Boundaries that do not bend light are passed.
PathTracer::End PathTracer::meet(Head& head, const kernels::Hit& hit, Vertex& vertex) {
    const Ray& ray = head.ray;
    vertex.out = -normalize(ray.direction);
    if (!flat::media_of(scene_).empty()) {
        Ray flight = ray;
        flight.t_max = hit.t;
        media_.trace(scene_, flight);
        const FreeFlight flown = media_.sample(head.depth, head.choose);
        vertex.light_odds = light_on_the_way(head, flown);
        head.throughput = flown.weight * head.throughput;
        if (flown.scatters) {
            vertex.surface.position = ray.at(flown.t);
            vertex.surface.material = {static_cast<std::uint32_t>(flown.phase), nullptr, nullptr};
            return End::vertex;
        }
        head.depth -= flown.depth;
    }
    if (hit.primitive == flat::RawHit::kMiss) return End::background;
    const SurfaceHit at = surface_at(scene_, ray, hit, scene_.features.texture_coordinates);
    vertex.surface = at.surface;
    vertex.primitive = hit.primitive;
    if (!at.index_matched) return End::vertex;
    head.ray = leave(at.surface, ray.direction, ray.time);
    return End::passes;
}

// Shadow rays for light that media scatter once on their way to the segment's begin. Where that is worth while the
// vertex at which the path itself is scattered asks for none: both draw the same light. Returns how much more densely
// its place was drawn for lights; 0 where it has to ask.
double PathTracer::light_on_the_way(const Head& head, const FreeFlight& flown) {
    if (!sample_lights_ || head.segment == max_depth_) return 0;
    const std::optional<Equiangular> along = pivot_.along(head.ray, media_);
    if (!along) return 0;
    head.path->sampler.seek(head.segment, Use::segment);
    const auto [t, choose, pick, u, v] = head.path->sampler.next_5d();
    ask(head, prepare_scattered_light(scene_, head.ray, media_, *along, {t, choose, {pick, {u, v}}}));
    return flown.scatters && flown.t <= along->stretch().to ? along->pdf(flown.t) / flown.density : 0;
}

// Light that the vertex emits, and a shadow ray for light that comes to it straight from an emitter.
bool PathTracer::shade(Head& head, const Vertex& vertex) {
    if (is_black(head.throughput)) return false;
    const double time = head.ray.time;
    if (vertex.primitive != flat::RawHit::kMiss) {
        const Color emission = emitted(scene_, vertex.surface);
        if (!is_black(emission)) {
            const double light_pdf = sample_lights_ && head.scatter_pdf > 0
                                         ? head.light_odds * pdf_light(scene_, head.previous, time, vertex.primitive,
                                                                       vertex.surface.position)
                                         : 0;
            const double weight = light_pdf > 0 ? power_heuristic(head.scatter_pdf, light_pdf) : 1;
            head.path->radiance += head.throughput * emission * weight;
        }
    }
    if (head.segment == max_depth_) return false;
    if (!sample_lights_) return true;
    head.previous = receiver_at(scene_, vertex.surface);
    head.light_odds = vertex.light_odds > 0 ? vertex.light_odds : 1;
    if (vertex.light_odds > 0 || !can_be_evaluated(scene_, vertex.surface.material)) return true;
    // The choice of a light shares its group with the point on it, so that each light gets a part of an even sequence.
    head.path->sampler.seek(head.segment, Use::light);
    const Random3 random = head.path->sampler.next_3d();
    ask(head, prepare_direct_light(scene_, vertex.surface, head.previous, vertex.out, time,
                                   {random.x, {random.y, random.z}}));
    return true;
}

void PathTracer::ask(const Head& head, const std::optional<DirectLight>& direct) {
    if (!direct || !count(direct->shadow)) return;
    shadows_.push_back({head.path, head.throughput * direct->light});
    traced_.push_back(direct->shadow);
}

// The next segment.
bool PathTracer::scatter(Head& head, const Vertex& vertex) {
    Sampler& sampler = head.path->sampler;
    sampler.seek(head.segment, Use::scattering);
    const std::optional<ScatterSample> scattered =
        sample_material(scene_, vertex.surface, vertex.out, sampler.next_3d());
    if (!scattered || is_black(scattered->weight)) return false;
    head.throughput *= scattered->weight;
    const double factor = scene_.features.background ? kSurvivalUnderSky : kSurvivalUnderLamps;
    const double survival = std::min(factor * max_component(head.throughput), kLargestSurvival);
    if (roulette_ && head.segment >= kRouletteStart && (survival < kLargestSurvival || max_depth_ == kUnlimitedDepth)) {
        sampler.seek(head.segment, Use::roulette);
        if (!(sampler.next() < survival)) return false;
        head.throughput = head.throughput / survival;
    }
    head.scatter_pdf = scattered->pdf;
    head.ray = leave(vertex.surface, scattered->direction, head.ray.time);
    ++head.segment;
    return begin(head);
}

void PathTracer::add_direct_light() {
    occluded_.resize(traced_.size());
    for (std::size_t i = 0; i < traced_.size(); i += kernels::kMostRays) {
        const std::size_t some = std::min(kernels::kMostRays, traced_.size() - i);
        kernels::are_occluded(scene_, std::span(traced_).subspan(i, some), &occluded_[i]);
    }
    for (std::size_t i = 0; i < shadows_.size(); ++i) {
        if (occluded_[i] != 0) continue;
        Color light = shadows_[i].light;
        if (!flat::media_of(scene_).empty()) {
            media_.trace(scene_, traced_[i]);
            light = light * media_.transmittance();
        }
        shadows_[i].path->radiance += light;
    }
}

}  // namespace limn::tracing
