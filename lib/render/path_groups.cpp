// Vertices on materials of one lobe, shaded side by side: what shade_alone does, in the same steps.
#include <bit>

#include "bsdf/isotropic.h"
#include "bsdf/lambertian.h"
#include "core/spawn.h"
#include "render/light_sampling.h"
#include "render/path.h"
#include "render/shading.h"

namespace limn::tracing {

namespace {

using kernels::Lobe;

Surface surface_of(const kernels::VertexLanes& lanes, std::size_t i) {
    Surface s;
    s.position = lanes.position.get<Point3>(i);
    s.position_error = lanes.position_error.get<Vec3>(i);
    s.normal = lanes.normal.get<Normal3>(i);
    s.shading_normal = lanes.shading_normal.get<Normal3>(i);
    return s;
}

}  // namespace

void PathTracer::gather(std::uint32_t path, double time, Lobe lobe, const Surface& vertex, bool ask_lights) {
    Group& group = group_of(lobe);
    kernels::VertexLanes& lanes = group.lanes;
    const std::size_t i = lanes.count++;
    group.paths[i] = path;
    group.times[i] = time;
    group.ask_lights[i] = ask_lights;
    lanes.position.set(i, vertex.position);
    lanes.position_error.set(i, vertex.position_error);
    lanes.normal.set(i, vertex.normal);
    lanes.shading_normal.set(i, vertex.shading_normal);
    lanes.albedo.set(i, albedo(scene_, vertex));
    if (lanes.count == kernels::kShaded) shade_group(lobe);
}

void PathTracer::shade_group(Lobe lobe) {
    Group& group = group_of(lobe);
    kernels::VertexLanes& lanes = group.lanes;
    if (lanes.count == 0) return;
    if (sample_lights_) sample_lights(lobe);
    draw<2>(group, Use::scattering);
    kernels::scatter(lobe, lanes);
    std::array<double, kernels::kShaded> survives{};
    bool roulette = false;
    for (std::size_t i = 0; i < lanes.count; ++i) {
        const Color weight = lanes.albedo.get<Color>(i);
        if (!(lanes.pdf[i] > 0) || is_black(weight)) continue;
        Head& head = heads_[group.paths[i]];
        head.throughput *= weight;
        survives[i] = survival(head);
        roulette = roulette || survives[i] < 1;
    }
    if (roulette) draw<1>(group, Use::roulette);
    for (std::size_t i = 0; i < lanes.count; ++i) {
        if (!(survives[i] == 1 || lanes.numbers[0][i] < survives[i])) continue;
        go_on(group.paths[i], survives[i], lanes.pdf[i],
              {lanes.origin.get<Point3>(i), lanes.direction.get<Vec3>(i), 0, kInfinity, group.times[i]});
    }
    lanes.count = 0;
}

void PathTracer::sample_lights(Lobe lobe) {
    Group& group = group_of(lobe);
    kernels::VertexLanes& lanes = group.lanes;
    // The choice of a light shares its group with the point on it, so that each light gets a part of an even sequence.
    draw<3>(group, Use::light);
    std::array<LightChoice, kernels::kShaded> choices;
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
    kernels::sample_lights(lobe, lanes);
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

template <std::size_t n>
void PathTracer::draw(Group& group, Use use) {
    const auto sampler_of = [&](std::size_t i) -> Sampler& {
        const std::uint32_t path = group.paths[i];
        paths_[path].sampler.seek(heads_[path].segment, use);
        return paths_[path].sampler;
    };
    Sampler::draw_many<n>(group.lanes.count, sampler_of, group.samplers, group.lanes.numbers);
}

}  // namespace limn::tracing
