// Directions towards lights that are infinitely far away.
#pragma once

#include "shading/lights.h"

namespace limn::lights {

// Where the light that was chosen is distant, a direction by numbers[1] and [2], in place of a point; without the
// choice of a light. Sets the end of all.
void sample_distant(const flat::Environment& map, const Receivers& receivers, LightSamples& samples);

// With which density sample_distant draws the direction of each hit, where that is a distant light.
void find_distant_pdf(const flat::Environment& map, std::size_t count, const flat::Light* const* lights,
                      LightHits& hits);

}  // namespace limn::lights
