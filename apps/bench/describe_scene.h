/// \file
/// Scenes for other renderers to read.
#pragma once

#include "figure.h"
#include "json_output.h"

namespace limn::bench {

// Returns camera, lights and objects as one JSON object, in world space and in double. apps/bench/peers writes the
// scenes of other renderers from it. The numbers come from the records that `compile` reads.
// \throws Error if no peer can express the scene
app::Json describe_scene(const Figure& figure);

}  // namespace limn::bench
