// Points on lights, one light for each receiver.
#pragma once

#include "shading/lights.h"

namespace limn::lights {

// Samples a point on each light in `samples`, by numbers[1] and [2]. The pdf is that of the point without the choice of
// the light.
void sample_points(const Receivers& receivers, LightSamples& samples);

// Returns in `pdf` the pdf with which sample_points() draws the direction to each position; 0 if it never does, or if
// the light is null. The position of a distant light is the direction towards it.
void find_point_pdf(const Receivers& receivers, const flat::Light* const* lights, const Rows3& position, Row& pdf);

}  // namespace limn::lights
