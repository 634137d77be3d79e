// Points on lights, drawn as the receivers see them, one light for each.
#pragma once

#include "shading/lights.h"

namespace limn::lights {

// By numbers[1] and [2] on the lights that are set; without the choice of a light.
void sample_points(const Receivers& receivers, LightSamples& samples);

// With which density sample_points draws the direction to each position; 0 where it never does.
void find_point_pdf(const Receivers& receivers, const flat::Light* const* lights, const Rows3& position, Row& pdf);

}  // namespace limn::lights
