#include "render/direct_light.h"

#include "core/spawn.h"
#include "render/light_sampling.h"
#include "render/shading.h"

namespace limn::tracing {

Receiver receiver_at(const flat::Scene& scene, const Surface& vertex) {
    return {vertex.position, scatters_back_only(scene, vertex.material) ? Vec3(vertex.normal) : Vec3{}};
}

std::optional<DirectLight> prepare_direct_light(const flat::Scene& scene, const Surface& vertex,
                                                const Receiver& receiver, const Vec3& out, double time,
                                                const LightNumbers& random, double vertex_odds) {
    const std::optional<LightSample> s = sample_light(scene, receiver, time, random.pick, random.uv.u, random.uv.v);
    if (!s) return std::nullopt;
    const ScatterValue f = material_value(scene, vertex, out, s->direction);
    if (is_black(f.value)) return std::nullopt;
    const Color emission = emitted(scene, s->point);
    if (is_black(emission)) return std::nullopt;
    return DirectLight{leave_for(vertex, s->point, time),
                       f.value * emission * (power_heuristic(vertex_odds * s->pdf, f.pdf) / s->pdf)};
}

}  // namespace limn::tracing
