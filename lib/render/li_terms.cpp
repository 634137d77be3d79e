#include "render/li_terms.h"

#include <optional>

#include "limn/math/warp.h"
#include "limn/scene/background.h"
#include "render/holes.h"
#include "shading/shading.h"

namespace limn::transport {

namespace {

// Returns the share of light that gets from one end of a ray to the other, through holes and media.
double transmittance(const flat::Scene& scene, const Ray& ray) {
    MediaAlongRay media;
    media.trace(scene, ray);
    return Holes().transmittance(scene, ray) * media.transmittance();
}

}  // namespace

SegmentNumbers::SegmentNumbers(const Sampler& sampler, std::uint32_t vertex) {
    const auto flight = sampler.numbers_of(Sampler::group_of(vertex, Use::flight));
    depth = sample_exponential(flight[0], 1);
    medium = flight[1];
    hole = sampler.numbers_of(Sampler::group_of(vertex, Use::holes))[0];
}

Color single_scattering(const PathSettings& settings, const Ray& ray, const MediaAlongRay& media,
                        const Equiangular& along, const Sampler& sampler, std::uint32_t vertex) {
    const auto [t, medium, pick, u, v] = sampler.numbers_of(Sampler::group_of(vertex, Use::segment));
    const FreeFlight flight = media.scatter_at(along.sample(t), medium);
    if (!flight.scatters) return {};
    const double pdf_ratio = along.pdf(flight.t) / flight.density;
    return flight.weight *
           direct_light(settings, point_in_medium(ray, flight), -ray.direction, ray.time, {pick, u, v}, pdf_ratio);
}

Color weighted_emission(const PathSettings& settings, const LastVertex& last, const Color& emission,
                        std::uint64_t primitive, const Point3& position, double time) {
    if (!settings.sample_lights || last.scatter_pdf == 0 || is_black(emission)) return emission;
    const double light_pdf =
        last.pdf_ratio * shade::pdf_light(settings.scene, last.receiver, time, primitive, position);
    return shade::power_heuristic(last.scatter_pdf, light_pdf) * emission;
}

Color distant_emission(const PathSettings& settings, const LastVertex& last, const Ray& ray) {
    const flat::Scene& scene = settings.scene;
    Color sum;
    if (scene.environment == nullptr)
        sum += Background{scene.background_bottom, scene.background_top}.radiance(ray.direction);
    for (std::size_t k = 0; k < scene.lights.distant.size(); ++k) {
        const Color emission = flat::seen_radiance(scene.lights.distant[k].light, ray.direction);
        sum += weighted_emission(settings, last, emission, flat::kFirstDistant + k, Point3{} + ray.direction, ray.time);
    }
    return sum;
}

Color direct_light(const PathSettings& settings, const Surface& x, const Vec3& wo, double time, const Random3& random,
                   double pdf_ratio) {
    const flat::Scene& scene = settings.scene;
    if (shade::is_specular(scene, x.material)) return {};
    const std::optional<shade::LightSample> light = shade::sample_light(scene, x, time, random);
    if (!light || !is_usable(light->shadow_ray)) return {};
    const ScatterValue f = shade::material_value(scene, x, wo, light->direction);
    const double light_pdf = pdf_ratio * light->pdf;
    const double weight = shade::power_heuristic(light_pdf, f.pdf);
    return (weight / light_pdf * transmittance(scene, light->shadow_ray)) * (f.value * light->radiance);
}

}  // namespace limn::transport
