/// \file
/// Scenes for other renderers to read.
#pragma once

#include "figure.h"
#include "json_output.h"

namespace limn::bench {

// Camera, background and objects as one JSON object, everything in world space and in double. apps/bench/peers writes
// the scenes of other renderers from it. The numbers come from the records that `compile` reads too, so that none is
// written down twice.
// \throws Error for what the writers of the peers do not know: motion, triangles and spheres within instances, noise,
// pictures, user-defined classes
app::Json describe_scene(const Figure& figure);

}  // namespace limn::bench
