#include "render/path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/spawn.h"
#include "limn/scene/background.h"
#include "render/shading.h"

namespace limn::transport {

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
    paths_ = paths;
    heads_.assign(paths.size(), {});
    next_.clear();
    for (std::uint32_t i = 0; i < paths.size(); ++i) {
        paths[i].radiance = {};
        begin(i, paths[i].ray);
    }
    while (!next_.paths.empty()) {
        std::swap(now_, next_);
        next_.clear();
        shadows_.clear();
        arriving_.clear();
        find_hits();
        for (std::size_t i = 0; i < hits_.size(); ++i) follow(now_.paths[i], now_.rays[i], hits_[i]);
        for (const shade::Lobe lobe : shade::kLobes) shade_group(lobe);
        shade_others();
        add_direct_light();
    }
}

// A new segment.
void PathTracer::begin(std::uint32_t path, const Ray& ray) {
    if (!scene_.media.empty()) {
        Head& head = heads_[path];
        Sampler& sampler = paths_[path].sampler;
        sampler.seek(head.segment, Use::flight);
        const Uv random = sampler.next_2d();
        head.depth = -std::log1p(-random.u);  // 53 bits: up to 36.7 mean free paths
        head.choose = random.v;
    }
    if (count(ray)) next_.add(path, ray);
}

void PathTracer::find_hits() {
    hits_.resize(now_.rays.size());
    for (std::size_t i = 0; i < hits_.size(); i += trace::kMostRays) {
        const std::size_t some = std::min(trace::kMostRays, hits_.size() - i);
        trace::closest_hits(scene_, std::span(now_.rays).subspan(i, some), &hits_[i]);
    }
}

// To the next surface or scattering in a medium, or the background. Boundaries that do not bend light are passed.
void PathTracer::follow(std::uint32_t path, const Ray& ray, const trace::Hit& hit) {
    if (!scene_.media.empty()) {
        Head& head = heads_[path];
        Ray flight = ray;
        flight.t_max = hit.t;
        media_.trace(scene_, flight);
        const FreeFlight flown = media_.sample(head.depth, head.choose);
        const double light_odds = light_on_the_way(path, ray, flown);
        head.throughput = flown.weight * head.throughput;
        if (flown.scatters) {
            Surface& inside = next_vertex().surface;
            inside = {};
            inside.position = ray.at(flown.t);
            inside.material = {static_cast<std::uint32_t>(flown.phase), nullptr, nullptr};
            return shade(path, ray, inside, light_odds);
        }
        head.depth -= flown.depth;
    }
    if (hit.primitive == flat::RawHit::kMiss) {
        const Background background{scene_.background_bottom, scene_.background_top};
        paths_[path].radiance += heads_[path].throughput * background.radiance(ray.direction);
        return;
    }
    query::SurfaceHit& met = next_vertex();
    query::surface_at(scene_, ray, hit, scene_.features.texture_coordinates, met);
    if (met.index_matched) {
        const Ray beyond = leave(met.surface, ray.direction, ray.time);
        if (count(beyond)) next_.add(path, beyond);
        return;
    }
    if (can_emit(scene_, met.surface.material)) add_emission(path, met.surface, hit.primitive, ray.time);
    shade(path, ray, met.surface);
}

// Shadow rays for light that media scatter once on their way to the segment's begin. Where that is worth while the
// vertex at which the path itself is scattered asks for none: both draw the same light. Returns how much more densely
// its place was drawn for lights; 0 where it has to ask.
double PathTracer::light_on_the_way(std::uint32_t path, const Ray& ray, const FreeFlight& flown) {
    const int segment = heads_[path].segment;
    if (!sample_lights_ || segment == max_depth_) return 0;
    const std::optional<Equiangular> along = pivot_.along(ray, media_);
    if (!along) return 0;
    Sampler& sampler = paths_[path].sampler;
    sampler.seek(segment, Use::segment);
    const auto [t, choose, pick, u, v] = sampler.next_5d();
    if (const auto light = prepare_scattered_light(scene_, ray, media_, *along, {t, choose, {pick, {u, v}}}))
        add_shadow(path, light->light, light->shadow);
    return flown.scatters && flown.t <= along->stretch().to ? along->pdf(flown.t) / flown.density : 0;
}

void PathTracer::add_emission(std::uint32_t path, const Surface& vertex, std::uint64_t primitive, double time) {
    const Head& head = heads_[path];
    const Color emission = emitted(scene_, vertex);
    if (is_black(emission) || is_black(head.throughput)) return;
    const double light_pdf = sample_lights_ && head.scatter_pdf > 0
                                 ? head.light_odds * pdf_light(scene_, head.previous, time, primitive, vertex.position)
                                 : 0;
    const double weight = light_pdf > 0 ? power_heuristic(head.scatter_pdf, light_pdf) : 1;
    paths_[path].radiance += head.throughput * emission * weight;
}

// Leaves the vertex to others of its kind: what comes now is done for many at once. `light_odds` over 0: lights were
// asked along the segment.
void PathTracer::shade(std::uint32_t path, const Ray& ray, const Surface& vertex, double light_odds) {
    Head& head = heads_[path];
    if (head.segment == max_depth_ || is_black(head.throughput)) return;
    const bool ask_lights = sample_lights_ && light_odds == 0;
    if (sample_lights_) set_receiver(scene_, vertex, head.previous);
    head.light_odds = light_odds > 0 ? light_odds : 1;
    if (const auto lobe = lobe_of(scene_, vertex.material)) {
        gather(path, ray, *lobe, vertex, ask_lights);
    } else {
        gather_other(path, ray, ask_lights);
    }
}

// With which probability Russian roulette lets the path go on.
double PathTracer::survival(const Head& head) const {
    if (!roulette_ || head.segment < kRouletteStart) return 1;
    const double factor = scene_.features.background ? kSurvivalUnderSky : kSurvivalUnderLamps;
    const double survival = factor * max_component(head.throughput);
    if (survival < kLargestSurvival) return survival;
    return max_depth_ == kUnlimitedDepth ? kLargestSurvival : 1;
}

// The next segment.
void PathTracer::go_on(std::uint32_t path, double survival, double pdf, const Ray& ray) {
    Head& head = heads_[path];
    if (survival < 1) head.throughput = head.throughput / survival;
    head.scatter_pdf = pdf;
    ++head.segment;
    begin(path, ray);
}

void PathTracer::add_shadow(std::uint32_t path, const Color& light, const Ray& ray) {
    if (!count(ray)) return;
    shadows_.add(path, ray);
    arriving_.push_back(heads_[path].throughput * light);
}

void PathTracer::add_direct_light() {
    occluded_.resize(shadows_.rays.size());
    for (std::size_t i = 0; i < occluded_.size(); i += trace::kMostRays) {
        const std::size_t some = std::min(trace::kMostRays, occluded_.size() - i);
        trace::are_occluded(scene_, std::span(shadows_.rays).subspan(i, some), &occluded_[i]);
    }
    for (std::size_t i = 0; i < occluded_.size(); ++i) {
        if (occluded_[i] != 0) continue;
        Color light = arriving_[i];
        if (!scene_.media.empty()) {
            media_.trace(scene_, shadows_.rays[i]);
            light = light * media_.transmittance();
        }
        paths_[shadows_.paths[i]].radiance += light;
    }
}

}  // namespace limn::transport
