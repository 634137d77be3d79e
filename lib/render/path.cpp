#include "render/path.h"

#include <algorithm>
#include <cmath>

#include "kernels/traverse.h"
#include "limn/scene/background.h"
#include "render/light_sampling.h"
#include "render/shading.h"
#include "render/surface_at.h"

namespace limn::tracing {

namespace {

// Unlimited paths end by Russian roulette from this many segments on: earlier ones carry most of the light.
constexpr int kRouletteStart = 4;
// Even a path that loses nothing must end some day; at 0.999 the variance that this adds is not measurable.
constexpr double kLargestSurvival = 0.999;

// Veach's power heuristic with exponent 2 (Robust Monte Carlo Methods for Light Transport Simulation, 1997, section
// 9.2.4), for the technique with density a against the one with density b.
double power_heuristic(double a, double b) {
    if (std::isinf(a)) return 1;
    const double ratio = b / a;
    return 1 / (1 + ratio * ratio);
}

}  // namespace

// Where a path stands: on a surface, or in a medium (then `surface` has no normal and the phase function as material).
struct PathTracer::Vertex {
    Surface surface;
    Vec3 out;  // unit, back along the path
    std::uint64_t primitive = flat::RawHit::kMiss;
};

// Whether the ray can be traced. A shape or material of extreme numbers can spoil one; it carries no light.
bool PathTracer::count(const Ray& ray) {
    ++rays_;
    if (is_usable(ray)) return true;
    ++unusable_rays_;
    return false;
}

// Follows the ray to the next surface or scattering in a medium, out of the scene, or nowhere. Boundaries that do not
// bend light are passed.
PathTracer::End PathTracer::advance(Ray ray, Vertex& vertex, Sampler& sampler) {
    vertex.out = -normalize(ray.direction);
    for (;;) {
        if (!count(ray)) return End::lost;
        const flat::RawHit hit = kernels::closest_hit(scene_, ray);
        if (!flat::media_of(scene_).empty()) {
            Ray flight = ray;
            flight.t_max = hit.t;
            media_.trace(scene_, flight);
            const Uv random = sampler.next_2d();
            if (const std::optional<FreeFlight> event = media_.sample(random.u, random.v)) {
                vertex.surface = {};
                vertex.surface.position = ray.at(event->t);
                vertex.surface.material = {static_cast<std::uint32_t>(event->phase), nullptr, nullptr};
                vertex.primitive = flat::RawHit::kMiss;
                return End::vertex;
            }
        }
        if (hit.primitive == flat::RawHit::kMiss) return End::background;
        const SurfaceHit at = surface_at(scene_, ray, hit, scene_.features.texture_coordinates);
        vertex.surface = at.surface;
        vertex.primitive = hit.primitive;
        if (!at.index_matched) return End::vertex;
        ray = at.surface.spawn_ray(ray.direction, ray.time);
    }
}

// The rendering equation by scattering: L = sum over path vertices of throughput * emission, where the throughput grows
// by f |cos| / pdf at each. With light sampling, every vertex also asks for the emission in one direction drawn towards
// a light. A direction that both ways could have found is counted by both, weighted so that the weights add to 1.
Color PathTracer::radiance(Ray ray, Sampler& sampler) {
    Color light, throughput{1, 1, 1};
    Vertex vertex;
    Point3 previous = ray.origin;
    double scatter_pdf = 0;  // of the last direction; 0: specular or from the camera, no light sampling competes
    for (int segment = 1; segment <= max_depth_; ++segment) {
        sampler.seek(segment, Use::flight);
        const End end = advance(ray, vertex, sampler);
        if (end == End::background)
            light += throughput * Background{scene_.background_bottom, scene_.background_top}.radiance(ray.direction);
        if (end != End::vertex) break;
        if (vertex.primitive != flat::RawHit::kMiss) {
            const Color emission = emitted(scene_, vertex.surface);
            if (!is_black(emission)) {
                const double light_pdf = sample_lights_ && scatter_pdf > 0
                                             ? pdf_light(scene_, vertex.primitive, previous, vertex.surface, ray.time)
                                             : 0;
                light += throughput * emission * (light_pdf > 0 ? power_heuristic(scatter_pdf, light_pdf) : 1);
            }
        }
        if (segment == max_depth_) break;
        if (sample_lights_ && can_be_evaluated(scene_, vertex.surface.material)) {
            sampler.seek(segment, Use::light);
            light += throughput * direct_light(vertex, ray.time, sampler);
        }

        sampler.seek(segment, Use::scattering);
        const std::optional<ScatterSample> scattered =
            sample_material(scene_, vertex.surface, vertex.out, sampler.next_3d());
        if (!scattered || is_black(scattered->weight)) break;
        throughput *= scattered->weight;
        if (max_depth_ == kUnlimitedDepth && segment >= kRouletteStart) {
            const double survival = std::min(max_component(throughput), kLargestSurvival);
            sampler.seek(segment, Use::roulette);
            if (!(sampler.next() < survival)) break;
            throughput = throughput / survival;
        }
        scatter_pdf = scattered->pdf;
        previous = vertex.surface.position;
        ray = vertex.surface.spawn_ray(scattered->direction, ray.time);
    }
    return light;
}

// f |cos| * emission * transmittance / pdf for one direction towards a light, weighted against finding it by
// scattering.
Color PathTracer::direct_light(const Vertex& vertex, double time, Sampler& sampler) {
    // The choice of a light shares its group with the point on it, so that each light gets a part of an even sequence.
    const Random3 pick = sampler.next_3d();
    const std::optional<LightSample> s = sample_light(scene_, vertex.surface.position, time, pick.x, pick.y, pick.z);
    if (!s) return {};
    const ScatterValue f = material_value(scene_, vertex.surface, vertex.out, s->direction);
    if (is_black(f.value)) return {};
    const Color emission = emitted(scene_, s->point);
    if (is_black(emission)) return {};
    const Ray shadow = vertex.surface.spawn_ray_to(s->point, time);
    if (!count(shadow) || kernels::is_occluded(scene_, shadow)) return {};
    double transmittance = 1;
    if (!flat::media_of(scene_).empty()) {
        media_.trace(scene_, shadow);
        transmittance = media_.transmittance();
    }
    return f.value * emission * (transmittance * power_heuristic(s->pdf, f.pdf) / s->pdf);
}

}  // namespace limn::tracing
