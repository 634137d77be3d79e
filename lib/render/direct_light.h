// The light that comes to a vertex straight from an emitter, in three steps, so that many shadow rays can be traced at
// once: prepare() draws where from and works out how much, the caller traces the ray, and adds the light if nothing is
// in the way.
#pragma once

#include <cmath>
#include <optional>

#include "flat/scene.h"
#include "limn/core/ray.h"
#include "limn/core/surface.h"
#include "render/light_choice.h"
#include "render/light_sampling.h"

namespace limn::transport {

// Three numbers that choose a light and a point on it.
struct LightNumbers {
    double pick;
    Uv uv;
};

struct DirectLight {
    Ray shadow;   // nothing is in the way if it hits nothing
    Color light;  // f |cos| * emission / pdf, weighed against finding it by scattering; media not yet counted
};

// How a vertex looks to lights.
void set_receiver(const flat::Scene& scene, const Surface& vertex, Receiver& receiver);

// Nothing where no light is drawn, or what is drawn gives none. `out`: unit, back along the path. `vertex_odds`: how
// much more densely this vertex was drawn than where paths scatter, if it was drawn for lights alone. \pre there are
// lights
std::optional<DirectLight> prepare_direct_light(const flat::Scene& scene, const Surface& vertex,
                                                const Receiver& receiver, const Vec3& out, double time,
                                                const LightNumbers& random, double vertex_odds = 1);

// From a point on a light, and what the vertex scatters from there.
std::optional<DirectLight> weigh_direct_light(const flat::Scene& scene, const Surface& vertex, const LightSample& light,
                                              const ScatterValue& f, double time, double vertex_odds = 1);

// Veach's power heuristic with exponent 2 (Robust Monte Carlo Methods for Light Transport Simulation, 1997, section
// 9.2.4), for the technique with density a against the one with density b.
inline double power_heuristic(double a, double b) {
    if (std::isinf(a)) return 1;
    const double ratio = b / a;
    return 1 / (1 + ratio * ratio);
}

}  // namespace limn::transport
