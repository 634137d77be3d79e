#include "render/li.h"

#include <algorithm>
#include <optional>

#include "math/spawn.h"
#include "query/surface_at.h"
#include "render/li_terms.h"
#include "shading/shading.h"
#include "shading/single.h"

namespace limn::transport {

// The rendering equation gives the light that leaves a vertex x in direction wo:
//
//     Lo(x, wo) = Le(x, wo) + integral of f(x, wo, wi) |cos wi| Li(x, wi) over all directions wi
//
// The path estimates the integral by one sample: it draws a direction wi, and divides the integrand by the pdf of wi.
// The same equation then gives Li(x, wi), which leaves the next vertex. The result is the sum of beta Le over the
// vertices of the path. The throughput beta is the product of f |cos| / pdf at the vertices before.
//
// Media scatter light like surfaces, with a phase function in place of f |cos|. The distance to the vertex is then
// random.
//
// There are two ways to find an emitter. Either the material is sampled and the ray hits the emitter, or a point of the
// emitter is sampled and the shadow ray arrives. Estimator::path does both, weighted by multiple importance sampling
// (Veach and Guibas 1995). Estimator::naive samples materials alone.
Path li(const PathSettings& settings, Ray ray, const Sampler& sampler) {
    const flat::Scene& scene = settings.scene;
    const auto draw = [&](std::uint32_t vertex, Use use) -> Random3 {
        const auto numbers = sampler.numbers_of(Sampler::group_of(vertex, use));
        return {numbers[0], numbers[1], numbers[2]};
    };
    Path path{sampler};
    Color& L = path.radiance;
    Color beta{1, 1, 1};
    std::uint32_t vertex = 1;  // number of the next vertex
    LastVertex last;           // where the ray begins
    SegmentNumbers random(sampler, vertex);

    while (is_usable(ray) && !is_black(beta)) {
        // Find the first surface that stops the ray. A surface with an opacity stops it at random.
        const trace::Hit hit = Holes().first_stop(scene, ray, trace::closest_hit(scene, ray), random.hole);

        // Sample the free flight through the media in front of the surface. Absorption reduces the throughput.
        MediaAlongRay media;
        media.trace(scene, {ray.origin, ray.direction, 0, hit.t, ray.time});
        const FreeFlight flight = media.sample(random.depth, random.medium);

        // Sample light that the media scatter into the ray once, at a point that is drawn by equiangular sampling. The
        // free flight may end at such a point too. Then pdf_ratio is the ratio of the pdfs of both ways to draw it.
        double pdf_ratio = 0;
        if (settings.sample_lights && vertex < settings.max_depth) {
            if (const std::optional<Equiangular> along = settings.pivot.along(ray, media)) {
                L += beta * single_scattering(settings, ray, media, *along, sampler, vertex);
                if (flight.scatters && flight.t <= along->stretch().to)
                    pdf_ratio = along->pdf(flight.t) / flight.density;
            }
        }
        beta = flight.weight * beta;

        // Find the next vertex, and add the light that it emits.
        Surface x;
        if (flight.scatters) {
            x = point_in_medium(ray, flight);
        } else {
            if (hit.primitive == flat::RawHit::kMiss) {
                // The ray leaves the scene. The camera does not see a transparent background.
                if (settings.transparent && vertex == 1)
                    path.clear = (beta.r + beta.g + beta.b) / 3;
                else
                    L += beta * distant_emission(settings, last, ray);
                break;
            }
            const query::SurfaceHit found =
                query::surface_at(scene, ray, hit, {scene.features.texture_coordinates, scene.features.tangents});
            x = found.surface;
            if (found.index_matched) {
                // The boundary of a medium does not change the direction of light.
                ray = leave(x, ray.direction, ray.time);
                random.depth -= flight.depth;
                continue;
            }
            L +=
                beta * weighted_emission(settings, last, shade::emitted(scene, x), hit.primitive, x.position, ray.time);
        }
        if (vertex == settings.max_depth) break;

        // Sample a light that x scatters, unless that light was sampled along the ray.
        const Vec3 wo = -ray.direction;
        if (settings.sample_lights && pdf_ratio == 0)
            L += beta * direct_light(settings, x, wo, ray.time, draw(vertex, Use::light), 1);

        // Sample the direction from which the path goes on.
        const std::optional<ScatterSample> wi = shade::sample_material(scene, x, wo, draw(vertex, Use::scattering));
        if (!wi) break;
        beta *= wi->weight;

        // End paths of small throughput by Russian roulette. A larger throughput of the others makes up for it.
        const auto& [start, factor, largest] = settings.roulette;
        const double survival = vertex < start ? 1 : std::min(factor * max_component(beta), largest);
        if (draw(vertex, Use::roulette).x >= survival) break;
        beta = beta / survival;

        // Start the next segment.
        last = {shade::receiver_at(scene, x), wi->pdf, pdf_ratio > 0 ? pdf_ratio : 1};
        ray = leave(x, wi->direction, ray.time);
        random = SegmentNumbers(sampler, ++vertex);
    }
    return path;
}

}  // namespace limn::transport
