// Directions towards emitters, each with its density per solid angle at the receiving point.
#pragma once

#include <optional>

#include "flat/scene.h"
#include "limn/core/surface.h"
#include "render/light_choice.h"

namespace limn::transport {

// A point on an emitter. `point` is complete but for front_face, which no emitter asks for: they are two-sided; and for
// texture coordinates where the radiance is the same everywhere.
struct LightSample {
    Surface point;
    Vec3 direction;  // unit, from the receiver
    double pdf = 0;  // per solid angle at the receiver, the choice of the light included
};

// Chooses a light by `pick` and a point on it by (u, v). Nothing where no light is on the receiver's side, or the one
// chosen is seen edge-on. \pre there are lights
std::optional<LightSample> sample_light(const flat::Scene& scene, const Receiver& receiver, double time, double pick,
                                        double u, double v);

// The same for a light that was chosen with this probability.
std::optional<LightSample> sample_chosen_light(const flat::Scene& scene, const flat::Light& light, double probability,
                                               const Receiver& receiver, double time, double u, double v);

// With which density sample_light would have drawn the direction from the receiver to `hit`, a point on primitive
// `number`; 0 if that is not a light that can be sampled.
double pdf_light(const flat::Scene& scene, const Receiver& receiver, double time, std::uint64_t number,
                 const Point3& hit);

}  // namespace limn::transport
