#include "render/path.h"

#include <algorithm>
#include <optional>

#include "limn/math/warp.h"
#include "limn/scene/background.h"
#include "math/spawn.h"
#include "shading/shading.h"

namespace limn::transport {

namespace {

using sampling::kShaded, sampling::kSlack;

constexpr sampling::Rows3 kFromEverywhere{};

}  // namespace

PathTracer::PathTracer(const flat::Scene& scene, int max_depth, Estimator estimator, bool transparent)
    : settings_(scene, max_depth, estimator, transparent),
      scene_(scene),
      has_holes_(std::any_of(scene.materials.begin(), scene.materials.end(), flat::has_holes)),
      now_(std::make_unique<shade::Segments>()),
      next_(std::make_unique<shade::Segments>()) {}

// The rendering equation by scattering: L = sum over path vertices of throughput * emission, where the throughput grows
// by f |cos| / pdf at each. With light sampling, every vertex also asks for the emission in one direction drawn towards
// a light. A direction that both ways could have found is counted by both, weighted so that the weights add to 1 (the
// power heuristic; Veach and Guibas 1995). For that each segment keeps `scatter_pdf`, the density by which scattering
// chose it: 0 where light sampling could not have, and whatever it finds counts whole. In media light is also sampled
// along a segment: `light_odds` is how much more densely its place was drawn for that than by free flight.
void PathTracer::trace(std::span<Path> paths) {
    begin(paths);
    while (next_->count > 0) {
        std::swap(now_, next_);
        next_->count = shadows_.count = 0;
        find_hits();
        for (std::size_t row = 0; row < now_->count; ++row) find_vertex(row);
        add_weighed_emission();
        for (Queue& queue : queues_) shade(queue);
        add_direct_light();
    }
}

void PathTracer::begin(std::span<Path> paths) {
    paths_ = paths;
    // What user-defined code that threw left behind.
    emitters_.count = shadows_.count = 0;
    for (Queue& queue : queues_) queue.vertices.count = queue.vertices.tangent_facets = 0;
    shade::Segments& s = *next_;
    s.count = 0;
    for (std::uint32_t i = 0; i < paths.size(); ++i) {
        const Ray ray = s.ray(i);
        if (!count(ray)) continue;
        const std::size_t row = s.count++;
        s.path[row] = i, s.vertex[row] = 1;
        s.base[row] = paths[i].sampler.base(), s.index[row] = paths[i].sampler.index();
        s.throughput.set(row, Color{1, 1, 1});
        s.set_ray(row, ray);
        s.scatter_pdf[row] = 0;
    }
    draw_flights(0);
}

bool PathTracer::count(const Ray& ray) {
    const bool usable = is_usable(ray);
    count({1, usable ? 0u : 1u});
    return usable;
}

void PathTracer::count(const shade::RayCounts& counts) { rays_ += counts.all, unusable_rays_ += counts.unusable; }

// Numbers for `count` paths from the first row on.
template <std::size_t n>
void PathTracer::draw(const sampling::PathRows<n>& paths, std::size_t first, std::size_t count, Use use,
                      std::size_t dimensions, sampling::Row* numbers) {
    std::uint32_t group[kShaded] = {};
    for (std::size_t i = 0; i < count; ++i) group[i] = Sampler::group_of(paths.vertex[first + i], use);
    const auto sampler_at = [&](std::size_t i) -> const Sampler& { return paths_[paths.path[first + i]].sampler; };
    draw_numbers({count, paths.base + first, paths.index + first, group}, dimensions, sampler_at, numbers);
}

// One for each of the next segments, from a row on: whether it passes holes.
void PathTracer::draw_holes(std::size_t first) {
    shade::Segments& s = *next_;
    for (; first < s.count; first += kShaded) {
        const std::size_t some = std::min(kShaded, s.count - first);
        sampling::Row numbers;
        draw(s, first, some, Use::holes, 1, &numbers);
        std::copy(numbers, numbers + some, s.hole + first);
    }
}

// What is drawn before a segment's hits are known: of the next segments, from a row on.
void PathTracer::draw_flights(std::size_t first) {
    if (has_holes_) draw_holes(first);
    if (scene_.media.empty()) return;
    shade::Segments& s = *next_;
    for (; first < s.count; first += kShaded) {
        const std::size_t some = std::min(kShaded, s.count - first);
        sampling::Row numbers[2];
        draw(s, first, some, Use::flight, 2, numbers);
        for (std::size_t i = 0; i < some; ++i) {
            s.depth[first + i] = sample_exponential(numbers[0][i], 1);  // 53 bits: up to 36.7 mean free paths
            s.choose[first + i] = numbers[1][i];
        }
    }
}

void PathTracer::find_hits() {
    shade::Segments& s = *now_;
    hits_.resize(s.count), ray_list_.resize(s.count);
    for (std::size_t i = 0; i < s.count; ++i) ray_list_[i] = s.ray(i);
    for (std::size_t i = 0; i < s.count; i += trace::kMostRays) {
        const std::size_t some = std::min(trace::kMostRays, s.count - i);
        trace::closest_hits(scene_, std::span(ray_list_).subspan(i, some), &hits_[i]);
    }
    if (!has_holes_) return;
    for (std::size_t i = 0; i < s.count; ++i) hits_[i] = holes_.first_stop(scene_, ray_list_[i], hits_[i], s.hole[i]);
}

// To the next surface or scattering in a medium, or the background. Boundaries that do not bend light are passed.
void PathTracer::find_vertex(std::size_t row) {
    const shade::Segments& s = *now_;
    const Ray& ray = ray_list_[row];
    const trace::Hit& hit = hits_[row];
    Color throughput = s.throughput.get<Color>(row);
    double depth = 0;
    if (!scene_.media.empty()) {
        Ray flight = ray;
        flight.t_max = hit.t;
        media_.trace(scene_, flight);
        const FreeFlight flown = media_.sample(s.depth[row], s.choose[row]);
        const double light_odds = want_light_on_the_way(row, flown);
        throughput = flown.weight * throughput;
        if (flown.scatters) return add_vertex(row, point_in_medium(ray, flown), throughput, light_odds);
        depth = s.depth[row] - flown.depth;
    }
    if (hit.primitive == flat::RawHit::kMiss) return escape(row, throughput);
    query::surface_at(scene_, ray, hit, {scene_.features.texture_coordinates, scene_.features.tangents}, met_);
    const Surface& vertex = met_.surface;
    if (met_.index_matched) return pass_boundary(row, vertex, throughput, depth);
    if (shade::can_emit(scene_, vertex.material))
        add_emission(row, throughput * shade::emitted(scene_, vertex), hit.primitive, vertex.position);
    add_vertex(row, vertex, throughput);
}

// Out of the scene: to the environment or the background, and the suns before it.
void PathTracer::escape(std::size_t row, const Color& throughput) {
    Path& path = paths_[now_->path[row]];
    if (settings_.transparent && now_->vertex[row] == 1) {
        path.clear = (throughput.r + throughput.g + throughput.b) / 3;
        return;
    }
    // Compilers assume that a null pointer is rare; here it is the usual case.
    if (scene_.environment == nullptr) [[likely]] {
        const Background background{scene_.background_bottom, scene_.background_top};
        path.radiance += throughput * background.radiance(ray_list_[row].direction);
    }
    if (!scene_.lights.distant.empty()) add_distant_emission(row, throughput);
}

// A function of its own, so that scenes without them do not save the registers that it needs.
void PathTracer::add_distant_emission(std::size_t row, const Color& throughput) {
    const Vec3& direction = ray_list_[row].direction;
    const std::vector<flat::DistantLight>& distant = scene_.lights.distant;
    for (std::size_t k = 0; k < distant.size(); ++k) {
        const Color radiance = flat::seen_radiance(distant[k].light, direction);
        add_emission(row, throughput * radiance, flat::kFirstDistant + k, direction);
    }
}

void PathTracer::pass_boundary(std::size_t row, const Surface& boundary, const Color& throughput, double depth) {
    const Ray beyond = leave(boundary, ray_list_[row].direction, now_->time[row]);
    if (!count(beyond)) return;
    shade::Segments& next = *next_;
    const std::size_t i = next.count++;
    sampling::copy_row<shade::SegmentRows>(next, i, *now_, row);
    next.throughput.set(i, throughput);
    next.set_ray(i, beyond);
    next.depth[i] = depth;
}

// A vertex for light that media scatter once on their way to the segment's begin. Where that is worth while the vertex
// at which the path itself is scattered samples none: both draw the same light. Returns how much more densely its
// place was drawn for lights; 0 where it has to sample.
double PathTracer::want_light_on_the_way(std::size_t row, const FreeFlight& flown) {
    if (!settings_.sample_lights || now_->vertex[row] == settings_.max_depth) return 0;
    const std::optional<Equiangular> along = settings_.pivot.along(ray_list_[row], media_);
    if (!along) return 0;
    const Sampler& sampler = paths_[now_->path[row]].sampler;
    const auto [t, choose, pick, u, v] = sampler.numbers_of(Sampler::group_of(now_->vertex[row], Use::segment));
    const FreeFlight flight = media_.scatter_at(along->sample(t), choose);
    const double odds = flight.scatters ? along->pdf(flight.t) / flight.density : 0;
    const Surface point = point_in_medium(ray_list_[row], flight);
    if (const bsdf::Lobe* lobe = shade::lobe_of(scene_, point.material);
        lobe && odds > 0 && !shade::is_specular(scene_, point.material)) {
        Queue& queue = queue_of(lobe, true);
        const std::size_t i = push(queue, row, point, (flight.weight / odds) * now_->throughput.get<Color>(row));
        queue.wants_light[i] = odds;
        queue.light_numbers[0][i] = pick, queue.light_numbers[1][i] = u, queue.light_numbers[2][i] = v;
        if (queue.vertices.count == kShaded) shade(queue);
    }
    return flown.scatters && flown.t <= along->stretch().to ? along->pdf(flown.t) / flown.density : 0;
}

// Light that arrives: of a primitive at a position, or of a distant light from a direction.
template <class Place>
void PathTracer::add_emission(std::size_t row, const Color& emission, std::uint64_t primitive, const Place& place) {
    const shade::Segments& s = *now_;
    if (is_black(emission)) return;
    if (!settings_.sample_lights || s.scatter_pdf[row] == 0) {
        paths_[s.path[row]].radiance += emission;
        return;
    }
    Emitters& e = emitters_;
    const std::size_t i = e.count++;
    e.paths[i] = s.path[row];
    e.emission[i] = emission;
    e.time[i] = s.time[row];
    sampling::copy_row<shade::LastVertexRows>(e, i, s, row);
    e.hits.primitive[i] = primitive, e.hits.position.set(i, place);
    if (e.count == kShaded) add_weighed_emission();
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
// sampled along the segment.
void PathTracer::add_vertex(std::size_t row, const Surface& vertex, const Color& throughput, double light_odds) {
    const MaterialRef& material = vertex.material;
    const bsdf::Lobe* lobe = shade::lobe_of(scene_, material);
    if (!lobe || now_->vertex[row] == settings_.max_depth || is_black(throughput)) return;
    Queue& queue = queue_of(lobe, false);
    const std::size_t i = push(queue, row, vertex, throughput);
    queue.wants_light[i] = settings_.sample_lights && light_odds == 0 && !shade::is_specular(scene_, material) ? 1 : 0;
    queue.light_odds[i] = light_odds > 0 ? light_odds : 1;
    if (queue.vertices.count == kShaded) shade(queue);
}

PathTracer::Queue& PathTracer::queue_of(const bsdf::Lobe* lobe, bool for_light_alone) {
    for (Queue& queue : queues_)
        if (queue.lobe == lobe && queue.for_light_alone == for_light_alone) return queue;
    return queues_.emplace_back(lobe, for_light_alone);
}

std::size_t PathTracer::push(Queue& queue, std::size_t row, const Surface& vertex, const Color& throughput) {
    const std::size_t i = queue.vertices.count++;
    sampling::copy_row<sampling::PathRows>(queue.paths, i, *now_, row);
    queue.paths.throughput.set(i, throughput);
    shade::set_vertex(scene_, vertex, ray_list_[row].direction, queue.vertices, i);
    return i;
}

void PathTracer::shade(Queue& queue) {
    const std::size_t count = queue.vertices.count;
    if (count == 0) return;
    // First what comes first on each path, so that its light is added up in the same order whichever paths
    // are traced with it.
    if (!queue.for_light_alone)
        for (Queue& earlier : queues_)
            if (earlier.for_light_alone) shade(earlier);
    if (std::any_of(queue.wants_light, queue.wants_light + count, [](double odds) { return odds > 0; }))
        sample_lights(queue);
    if (!queue.for_light_alone) scatter(queue);
    queue.vertices.count = queue.vertices.tangent_facets = 0;
}

void PathTracer::sample_lights(Queue& queue) {
    bsdf::Vertices& vertices = queue.vertices;
    lights::LightSamples& lights = light_samples_;
    // The choice of a light shares its group with the point on it, so that each light gets a part of an even sequence.
    if (!queue.for_light_alone) draw(queue.paths, 0, vertices.count, Use::light, 3, queue.light_numbers);
    lights.numbers = queue.light_numbers;
    const sampling::Rows3& sides = queue.lobe->one_sided ? vertices.normal : kFromEverywhere;
    lights::sample(scene_, {vertices.count, vertices.position, sides, queue.paths.time}, lights);
    bsdf::value(*queue.lobe, vertices, lights.direction);
    sampling::Rows3 emission;
    for (std::size_t i = 0; i < vertices.count; ++i) {
        const bool lit = queue.wants_light[i] > 0 && lights.pdf[i] > 0 && !is_black(vertices.value.get<Color>(i));
        emission.set(i, lit ? shade::radiance_of(scene_, lights, i) : Color{});
    }
    count(shade::add_shadow_rays(queue.paths, vertices, lights, emission, queue.wants_light, shadows_));
}

void PathTracer::scatter(Queue& queue) {
    bsdf::Vertices& vertices = queue.vertices;
    draw(queue.paths, 0, vertices.count, Use::scattering, queue.lobe->numbers, vertices.numbers);
    bsdf::sample(*queue.lobe, vertices);
    sampling::Row survival, numbers = {};
    if (shade::scatter(settings_.roulette, vertices, queue.paths, survival))
        draw(queue.paths, 0, vertices.count, Use::roulette, 1, &numbers);
    const std::size_t first = next_->count;
    count(
        shade::add_segments(queue.paths, vertices, queue.lobe->one_sided, survival, numbers, queue.light_odds, *next_));
    draw_flights(first);
}

void PathTracer::add_direct_light() {
    const shade::ShadowRays& s = shadows_;
    ray_list_.resize(s.count), occluded_.resize(s.count);
    for (std::size_t i = 0; i < s.count; ++i)
        ray_list_[i] = {s.origin.get<Point3>(i), s.direction.get<Vec3>(i), 0, s.end[i], s.time[i]};
    for (std::size_t i = 0; i < s.count; i += trace::kMostRays) {
        const std::size_t some = std::min(trace::kMostRays, s.count - i);
        trace::are_occluded(scene_, std::span(ray_list_).subspan(i, some), &occluded_[i]);
    }
    for (std::size_t i = 0; i < s.count; ++i) {
        if (occluded_[i] != 0 && !has_holes_) continue;
        Color light = s.light.get<Color>(i);
        if (occluded_[i] != 0) light = holes_.transmittance(scene_, ray_list_[i]) * light;
        if (!scene_.media.empty()) {
            media_.trace(scene_, ray_list_[i]);
            light = light * media_.transmittance();
        }
        paths_[s.path[i]].radiance += light;
    }
}

}  // namespace limn::transport
