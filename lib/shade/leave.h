// How paths and shadow rays leave vertices, for many at once: offset_along and leave_for (core/spawn.h) in lanes.
#pragma once

#include "bsdf/lobe.h"
#include "lights/lights.h"

namespace limn::shade {

using sampling::Row, sampling::Rows3;

// Where the next segments begin.
void find_origins(const bsdf::Vertices& vertices, Rows3& origin);

struct ShadowRays {
    Rows3 origin, direction;  // up to kShadowEnd before t = 1
    Rows3 light;  // f |cos| emission / pdf, weighed against finding it by scattering; black where none can arrive
};

// \param vertices with the value for the direction of each light
// \param odds how much more densely a vertex was drawn than where paths scatter, if it was drawn for lights alone
void weigh_light(const bsdf::Vertices& vertices, const lights::LightSamples& samples, const Rows3& emission,
                 const Row& odds, ShadowRays& shadows);

// The weight of light that was found by scattering, against finding it by sampling lights.
void weigh_emission(std::size_t count, const Row& scatter_pdf, const Row& light_pdf, Row& weight);

}  // namespace limn::shade
