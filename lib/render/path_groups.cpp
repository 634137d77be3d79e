// Many vertices shaded at once: a shadow ray for light that comes to each straight from an emitter, and the next
// segment. Those on materials of one lobe side by side, the others one after the other in the same steps.
#include <algorithm>
#include <bit>

#include "bsdf/isotropic.h"
#include "bsdf/lambertian.h"
#include "core/spawn.h"
#include "render/light_sampling.h"
#include "render/path.h"
#include "render/shading.h"

namespace limn::transport {

namespace {

using shade::Lobe;

Surface surface_of(const shade::VertexLanes& lanes, std::size_t i) {
    Surface s;
    s.position = lanes.position.get<Point3>(i);
    s.position_error = lanes.position_error.get<Vec3>(i);
    s.normal = lanes.normal.get<Normal3>(i);
    s.shading_normal = lanes.shading_normal.get<Normal3>(i);
    return s;
}

}  // namespace

void PathTracer::gather(std::uint32_t path, const Ray& ray, Lobe lobe, const Surface& vertex, bool ask_lights) {
    Group& group = group_of(lobe);
    shade::VertexLanes& lanes = group.lanes;
    const std::size_t i = lanes.count++;
    group.paths[i] = path;
    group.times[i] = ray.time;
    group.ask_lights[i] = ask_lights;
    lanes.position.set(i, vertex.position);
    lanes.position_error.set(i, vertex.position_error);
    lanes.normal.set(i, vertex.normal);
    lanes.shading_normal.set(i, vertex.shading_normal);
    if (lobe == Lobe::dielectric) {
        const MaterialRecord& glass = scene_.materials[vertex.material.id];
        lanes.albedo.set(i, Color{1, 1, 1});
        lanes.out.set(i, -normalize(ray.direction));
        lanes.eta[i] = vertex.front_face ? glass.parameter : 1 / glass.parameter;
        lanes.exact_fresnel[i] = glass.fresnel == Fresnel::exact ? 1 : 0;
    } else {
        lanes.albedo.set(i, albedo(scene_, vertex));
    }
    if (lanes.count == sampling::kShaded) shade_group(lobe);
}

void PathTracer::shade_group(Lobe lobe) {
    Group& group = group_of(lobe);
    shade::VertexLanes& lanes = group.lanes;
    if (lanes.count == 0) return;
    if (sample_lights_ && lobe != Lobe::dielectric) sample_lights(lobe);
    draw<2>(group, lanes.count, Use::scattering, lanes.numbers);
    shade::scatter(lobe, lanes);
    std::array<double, sampling::kShaded> survives{};
    bool roulette = false;
    for (std::size_t i = 0; i < lanes.count; ++i) {
        const Color weight = lanes.albedo.get<Color>(i);
        if (!(lanes.scattered >> i & 1) || is_black(weight)) continue;
        Head& head = heads_[group.paths[i]];
        head.throughput *= weight;
        survives[i] = survival(head);
        roulette = roulette || survives[i] < 1;
    }
    if (roulette) draw<1>(group, lanes.count, Use::roulette, lanes.numbers);
    for (std::size_t i = 0; i < lanes.count; ++i) {
        if (!(survives[i] == 1 || lanes.numbers[0][i] < survives[i])) continue;
        go_on(group.paths[i], survives[i], lanes.pdf[i],
              {lanes.origin.get<Point3>(i), lanes.direction.get<Vec3>(i), 0, kInfinity, group.times[i]});
    }
    lanes.count = 0;
}

void PathTracer::sample_lights(Lobe lobe) {
    Group& group = group_of(lobe);
    shade::VertexLanes& lanes = group.lanes;
    // The choice of a light shares its group with the point on it, so that each light gets a part of an even sequence.
    draw<3>(group, lanes.count, Use::light, lanes.numbers);
    std::array<LightChoice, sampling::kShaded> choices;
    choose_lights(scene_.lights, lobe, lanes, choices.data());
    std::uint32_t textured = 0;
    for (std::size_t i = 0; i < lanes.count; ++i) {
        lanes.probability[i] = group.ask_lights[i] ? choices[i].probability : 0;
        if (lanes.probability[i] == 0) continue;
        const flat::Light& light = flat::light_at(scene_, choices[i].rank, group.times[i], group.lights[i]);
        lanes.light[i] = &light;
        lanes.emission.set(i, radiance_of(scene_, light));
        if (light.textured) textured |= std::uint32_t{1} << i;
    }
    shade::sample_lights(lobe, lanes);
    for (std::uint32_t rest = lanes.lit & ~textured; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        add_shadow(group.paths[i], lanes.arriving.get<Color>(i),
                   {lanes.shadow_origin.get<Point3>(i), lanes.shadow_direction.get<Vec3>(i), 0, 1 - kShadowEnd,
                    group.times[i]});
    }
    for (std::uint32_t rest = lanes.open | textured; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        const std::uint32_t path = group.paths[i];
        const double time = group.times[i];
        const auto light = sample_chosen_light(scene_, *lanes.light[i], lanes.probability[i], heads_[path].previous,
                                               time, lanes.numbers[1][i], lanes.numbers[2][i]);
        if (!light) continue;
        const Surface vertex = surface_of(lanes, i);
        const Color albedo = lanes.albedo.get<Color>(i);
        const ScatterValue f = lobe == Lobe::lambertian
                                   ? bsdf::value_lambertian(albedo, vertex, Vec3{}, light->direction)
                                   : bsdf::value_isotropic(albedo);
        if (const auto direct = weigh_direct_light(scene_, vertex, *light, f, time))
            add_shadow(path, direct->light, direct->shadow);
    }
}

void PathTracer::gather_other(std::uint32_t path, const Ray& ray, bool ask_lights) {
    const std::size_t i = others_.count++;
    others_.paths[i] = path;
    others_.rays[i] = ray;
    others_.ask_lights[i] = ask_lights && can_be_evaluated(scene_, others_.hits[i].surface.material);
    if (others_.count == sampling::kShaded) shade_others();
}

void PathTracer::shade_others() {
    if (others_.count == 0) return;
    const auto asking = std::span(others_.ask_lights).first(others_.count);
    if (std::ranges::count(asking, true) > 0) draw<3>(others_, others_.count, Use::light, others_.light_numbers);
    draw<3>(others_, others_.count, Use::scattering, others_.numbers);
    for (std::size_t i = 0; i < others_.count; ++i) shade_other(i);
    others_.count = 0;
}

void PathTracer::shade_other(std::size_t i) {
    const std::uint32_t path = others_.paths[i];
    const Ray& ray = others_.rays[i];
    const Surface& vertex = others_.hits[i].surface;
    Head& head = heads_[path];
    const Vec3 out = -normalize(ray.direction);
    if (others_.ask_lights[i]) {
        const auto& [pick, u, v] = others_.light_numbers;
        if (const auto direct =
                prepare_direct_light(scene_, vertex, head.previous, out, ray.time, {pick[i], {u[i], v[i]}}))
            add_shadow(path, direct->light, direct->shadow);
    }
    const auto& [x, y, z] = others_.numbers;
    const std::optional<ScatterSample> scattered = sample_material(scene_, vertex, out, {x[i], y[i], z[i]});
    if (!scattered || is_black(scattered->weight)) return;
    head.throughput *= scattered->weight;
    const double survives = survival(head);
    if (survives < 1) {
        Sampler& sampler = paths_[path].sampler;
        sampler.seek(head.segment, Use::roulette);
        if (!(sampler.next() < survives)) return;
    }
    go_on(path, survives, scattered->pdf, leave(vertex, scattered->direction, ray.time));
}

template <std::size_t n>
void PathTracer::draw(Company& company, std::size_t count, Use use, sampling::Lane* numbers) {
    const auto sampler_of = [&](std::size_t i) -> Sampler& {
        const std::uint32_t path = company.paths[i];
        paths_[path].sampler.seek(heads_[path].segment, use);
        return paths_[path].sampler;
    };
    Sampler::draw_many<n>(count, sampler_of, company.samplers, numbers);
}

}  // namespace limn::transport
