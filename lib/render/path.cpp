#include "render/path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/spawn.h"
#include "limn/scene/background.h"
#include "shade/shading.h"

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

constexpr sampling::Rows3 kFromEverywhere{};

}  // namespace

PathTracer::PathTracer(const flat::Scene& scene, int max_depth, Estimator estimator)
    : scene_(scene),
      max_depth_(max_depth),
      sample_lights_(estimator == Estimator::path && !scene.lights.empty()),
      pivot_(scene),
      roulette_(estimator == Estimator::path || max_depth == kUnlimitedDepth) {}

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
    states_.assign(paths.size(), {});
    next_.clear();
    for (std::uint32_t i = 0; i < paths.size(); ++i) {
        paths[i].radiance = {};
        begin_segment(i, paths[i].ray);
    }
    while (!next_.paths.empty()) {
        std::swap(now_, next_);
        next_.clear();
        shadows_.clear();
        arriving_.clear();
        find_hits();
        for (std::size_t i = 0; i < hits_.size(); ++i) find_vertex(now_.paths[i], now_.rays[i], hits_[i]);
        add_weighed_emission();
        for (Queue& queue : queues_) shade(queue);
        add_direct_light();
    }
}

void PathTracer::begin_segment(std::uint32_t path, const Ray& ray) {
    if (!scene_.media.empty()) {
        State& state = states_[path];
        Sampler& sampler = paths_[path].sampler;
        sampler.seek(state.segment, Use::flight);
        const Uv random = sampler.next_2d();
        state.depth = -std::log1p(-random.u);  // 53 bits: up to 36.7 mean free paths
        state.choose = random.v;
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
void PathTracer::find_vertex(std::uint32_t path, const Ray& ray, const trace::Hit& hit) {
    Surface& vertex = met_.surface;
    if (!scene_.media.empty()) {
        State& state = states_[path];
        Ray flight = ray;
        flight.t_max = hit.t;
        media_.trace(scene_, flight);
        const FreeFlight flown = media_.sample(state.depth, state.choose);
        const double light_odds = want_light_on_the_way(path, ray, flown);
        state.throughput = flown.weight * state.throughput;
        if (flown.scatters) {
            vertex = {};
            vertex.position = ray.at(flown.t);
            vertex.material.id = static_cast<std::uint32_t>(flown.phase);
            return add_vertex(path, ray, vertex, light_odds);
        }
        state.depth -= flown.depth;
    }
    if (hit.primitive == flat::RawHit::kMiss) {
        const Background background{scene_.background_bottom, scene_.background_top};
        paths_[path].radiance += states_[path].throughput * background.radiance(ray.direction);
        return;
    }
    query::surface_at(scene_, ray, hit, scene_.features.texture_coordinates, met_);
    if (met_.index_matched) {
        const Ray beyond = leave(vertex, ray.direction, ray.time);
        if (count(beyond)) next_.add(path, beyond);
        return;
    }
    if (shade::can_emit(scene_, vertex.material)) add_emission(path, vertex, hit.primitive, ray.time);
    add_vertex(path, ray, vertex);
}

// A vertex for light that media scatter once on their way to the segment's begin. Where that is worth while the vertex
// at which the path itself is scattered asks for none: both draw the same light. Returns how much more densely its
// place was drawn for lights; 0 where it has to ask.
double PathTracer::want_light_on_the_way(std::uint32_t path, const Ray& ray, const FreeFlight& flown) {
    const int segment = states_[path].segment;
    if (!sample_lights_ || segment == max_depth_) return 0;
    const std::optional<Equiangular> along = pivot_.along(ray, media_);
    if (!along) return 0;
    Sampler& sampler = paths_[path].sampler;
    sampler.seek(segment, Use::segment);
    const auto [t, choose, pick, u, v] = sampler.next_5d();
    const FreeFlight flight = media_.scatter_at(along->sample(t), choose);
    const double odds = flight.scatters ? along->pdf(flight.t) / flight.density : 0;
    Surface& point = met_.surface;
    point = {};
    point.position = ray.at(flight.t);
    point.material.id = static_cast<std::uint32_t>(flight.phase);
    if (const bsdf::Lobe* lobe = shade::lobe_of(scene_, point.material);
        lobe && odds > 0 && !shade::is_specular(scene_, point.material)) {
        Queue& queue = queue_of(lobe, true);
        const std::size_t i = push(queue, path, ray, point, (flight.weight / odds) * states_[path].throughput);
        queue.wants_light[i] = true;
        queue.light_odds[i] = odds;
        queue.light_numbers[0][i] = pick, queue.light_numbers[1][i] = u, queue.light_numbers[2][i] = v;
        if (queue.vertices.count == bsdf::kShaded) shade(queue);
    }
    return flown.scatters && flown.t <= along->stretch().to ? along->pdf(flown.t) / flown.density : 0;
}

void PathTracer::add_emission(std::uint32_t path, const Surface& vertex, std::uint64_t primitive, double time) {
    const State& state = states_[path];
    const Color emission = shade::emitted(scene_, vertex);
    if (is_black(emission) || is_black(state.throughput)) return;
    if (!sample_lights_ || state.scatter_pdf == 0) {
        paths_[path].radiance += state.throughput * emission;
        return;
    }
    Emitters& e = emitters_;
    const std::size_t i = e.count++;
    e.paths[i] = path;
    e.emission[i] = state.throughput * emission;
    e.receiver.set(i, state.receiver), e.receiver_normal.set(i, state.receiver_normal);
    e.time[i] = time, e.scatter_pdf[i] = state.scatter_pdf, e.light_odds[i] = state.light_odds;
    e.hits.primitive[i] = primitive, e.hits.position.set(i, vertex.position);
    if (e.count == bsdf::kShaded) add_weighed_emission();
}

void PathTracer::add_weighed_emission() {
    Emitters& e = emitters_;
    if (e.count == 0) return;
    lights::find_pdf(scene_, {e.count, e.receiver, e.receiver_normal, e.time}, e.hits);
    for (std::size_t i = 0; i < e.count; ++i) e.hits.pdf[i] *= e.light_odds[i];
    sampling::Row weight;
    shade::weigh_emission(e.count, e.scatter_pdf, e.hits.pdf, weight);
    for (std::size_t i = 0; i < e.count; ++i) paths_[e.paths[i]].radiance += weight[i] * e.emission[i];
    e.count = 0;
}

// Leaves the vertex to others of its lobe: what comes now is done for many at once. `light_odds` over 0: lights were
// asked along the segment.
void PathTracer::add_vertex(std::uint32_t path, const Ray& ray, const Surface& vertex, double light_odds) {
    State& state = states_[path];
    const bsdf::Lobe* lobe = shade::lobe_of(scene_, vertex.material);
    if (!lobe || state.segment == max_depth_ || is_black(state.throughput)) return;
    state.light_odds = light_odds > 0 ? light_odds : 1;
    state.receiver = vertex.position;
    state.receiver_normal = lobe->one_sided ? Vec3(vertex.normal) : Vec3{};
    Queue& queue = queue_of(lobe, false);
    const std::size_t i = push(queue, path, ray, vertex, state.throughput);
    queue.wants_light[i] = sample_lights_ && light_odds == 0 && !shade::is_specular(scene_, vertex.material);
    queue.light_odds[i] = 1;
    if (queue.vertices.count == bsdf::kShaded) shade(queue);
}

PathTracer::Queue& PathTracer::queue_of(const bsdf::Lobe* lobe, bool for_light_alone) {
    for (Queue& queue : queues_)
        if (queue.lobe == lobe && queue.for_light_alone == for_light_alone) return queue;
    return queues_.emplace_back(lobe, for_light_alone);
}

std::size_t PathTracer::push(Queue& queue, std::uint32_t path, const Ray& ray, const Surface& vertex,
                             const Color& throughput) {
    const std::size_t i = queue.vertices.count++;
    queue.paths[i] = path;
    queue.time[i] = ray.time;
    queue.throughput[i] = throughput;
    shade::set_vertex(scene_, vertex, -normalize(ray.direction), queue.vertices, i);
    return i;
}

void PathTracer::shade(Queue& queue) {
    if (queue.vertices.count == 0) return;
    // First what comes first on each path, so that its light is added up in the same order in any company.
    if (!queue.for_light_alone)
        for (Queue& earlier : queues_)
            if (earlier.for_light_alone) shade(earlier);
    if (std::find(queue.wants_light.begin(), queue.wants_light.begin() + queue.vertices.count, true) !=
        queue.wants_light.begin() + queue.vertices.count)
        sample_lights(queue);
    if (!queue.for_light_alone) scatter(queue);
    queue.vertices.count = 0;
}

void PathTracer::draw(Queue& queue, Use use, std::size_t n, sampling::Row* numbers) {
    const auto sampler_of = [&](std::size_t i) -> Sampler& {
        const std::uint32_t path = queue.paths[i];
        paths_[path].sampler.seek(states_[path].segment, use);
        return paths_[path].sampler;
    };
    Sampler::draw_many(n, queue.vertices.count, sampler_of, samplers_, numbers);
}

void PathTracer::sample_lights(Queue& queue) {
    bsdf::Vertices& vertices = queue.vertices;
    lights::LightSamples& lights = light_samples_;
    // The choice of a light shares its group with the point on it, so that each light gets a part of an even sequence.
    if (!queue.for_light_alone) draw(queue, Use::light, 3, queue.light_numbers);
    lights.numbers = queue.light_numbers;
    lights::sample(
        scene_,
        {vertices.count, vertices.position, queue.lobe->one_sided ? vertices.normal : kFromEverywhere, queue.time},
        lights);
    queue.lobe->value(vertices, lights.direction);
    sampling::Rows3 emission;
    for (std::size_t i = 0; i < vertices.count; ++i) {
        const bool lit = queue.wants_light[i] && lights.pdf[i] > 0 && !is_black(vertices.value.get<Color>(i));
        emission.set(i, lit ? shade::radiance_of(scene_, lights, i) : Color{});
    }
    shade::weigh_light(vertices, lights, emission, queue.light_odds, shadow_rows_);
    for (std::size_t i = 0; i < vertices.count; ++i) {
        const Color light = shadow_rows_.light.get<Color>(i);
        if (is_black(light) || !queue.wants_light[i]) continue;
        add_shadow(queue.paths[i], queue.throughput[i] * light,
                   {shadow_rows_.origin.get<Point3>(i), shadow_rows_.direction.get<Vec3>(i), 0, 1 - kShadowEnd,
                    queue.time[i]});
    }
}

// The next segments.
void PathTracer::scatter(Queue& queue) {
    bsdf::Vertices& vertices = queue.vertices;
    draw(queue, Use::scattering, queue.lobe->numbers, vertices.numbers);
    queue.lobe->sample(vertices);
    sampling::Rows3& origin = shadow_rows_.origin;
    shade::find_origins(vertices, origin);
    sampling::Row survives = {}, roulette = {};
    bool some_end = false;
    for (std::size_t i = 0; i < vertices.count; ++i) {
        State& state = states_[queue.paths[i]];
        state.throughput *= vertices.weight.get<Color>(i);
        survives[i] = is_black(state.throughput) ? 0 : survival(state);
        some_end = some_end || survives[i] < 1;
    }
    if (some_end) draw(queue, Use::roulette, 1, &roulette);
    for (std::size_t i = 0; i < vertices.count; ++i) {
        if (!(survives[i] == 1 || roulette[i] < survives[i])) continue;
        State& state = states_[queue.paths[i]];
        state.throughput = state.throughput / survives[i];
        state.scatter_pdf = vertices.pdf[i];
        ++state.segment;
        begin_segment(queue.paths[i],
                      {origin.get<Point3>(i), vertices.direction.get<Vec3>(i), 0, kInfinity, queue.time[i]});
    }
}

// With which probability Russian roulette lets the path go on.
double PathTracer::survival(const State& state) const {
    if (!roulette_ || state.segment < kRouletteStart) return 1;
    const double factor = scene_.features.background ? kSurvivalUnderSky : kSurvivalUnderLamps;
    const double survival = factor * max_component(state.throughput);
    if (survival < kLargestSurvival) return survival;
    return max_depth_ == kUnlimitedDepth ? kLargestSurvival : 1;
}

void PathTracer::add_shadow(std::uint32_t path, const Color& light, const Ray& ray) {
    if (!count(ray)) return;
    shadows_.add(path, ray);
    arriving_.push_back(light);
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
