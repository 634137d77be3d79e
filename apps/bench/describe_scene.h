/// \file
/// Scenes for other renderers to read.
#pragma once

#include "figure.h"
#include "json_output.h"

namespace limn::bench {

// Camera, background and objects as one JSON object, everything in world space and in double: what apps/bench/peers
// writes the scenes of other renderers from. It is read off the records that `compile` reads too, so that no number is
// written down twice.
// \throws Error for what the peers' writers do not know: motion, triangles and spheres within instances, noise,
// pictures, classes from outside limn
app::Json describe_scene(const Figure& figure);

}  // namespace limn::bench
