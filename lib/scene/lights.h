// Converts light sources to records.
#pragma once

#include "limn/records/records.h"
#include "limn/scene/lights.h"

namespace limn {

/// Returns the record of a light source. \throws ArgumentError that names the field if a value is out of range
LightRecord record_of(const LightSource& light);

}  // namespace limn
