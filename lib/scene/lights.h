// Lights that are no shapes, as records.
#pragma once

#include "limn/records.h"
#include "limn/scene/lights.h"

namespace limn {

/// \throws ArgumentError that names the field
LightRecord record_of(const LightSource& light);

}  // namespace limn
