// Checks light sources.
#pragma once

#include "limn/scene/lights.h"

namespace limn {

// Throws ArgumentError that names the field if a value of a light source is out of range.
void check(const LightSource& light);

}  // namespace limn
