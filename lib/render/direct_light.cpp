#include "render/direct_light.h"

#include "core/spawn.h"
#include "render/shading.h"

namespace limn::transport {

void set_receiver(const flat::Scene& scene, const Surface& vertex, Receiver& receiver) {
    receiver.position = vertex.position;
    receiver.normal = (scatters_back_only(scene, vertex.material) ? 1.0 : 0.0) * Vec3(vertex.normal);
}

std::optional<DirectLight> prepare_direct_light(const flat::Scene& scene, const Surface& vertex,
                                                const Receiver& receiver, const Vec3& out, double time,
                                                const LightNumbers& random, double vertex_odds) {
    const std::optional<LightSample> s = sample_light(scene, receiver, time, random.pick, random.uv.u, random.uv.v);
    if (!s) return std::nullopt;
    return weigh_direct_light(scene, vertex, *s, material_value(scene, vertex, out, s->direction), time, vertex_odds);
}

std::optional<DirectLight> weigh_direct_light(const flat::Scene& scene, const Surface& vertex, const LightSample& light,
                                              const ScatterValue& f, double time, double vertex_odds) {
    if (is_black(f.value)) return std::nullopt;
    const Color emission = emitted(scene, light.point);
    if (is_black(emission)) return std::nullopt;
    return DirectLight{leave_for(vertex, light.point, time),
                       f.value * emission * (power_heuristic(vertex_odds * light.pdf, f.pdf) / light.pdf)};
}

}  // namespace limn::transport
