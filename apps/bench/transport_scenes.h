/// \file
/// The scenes of `./build.sh convergence`. Only public headers of limn, the figures and the gallery are needed.
#pragma once

#include <string>
#include <vector>

#include "figure.h"

namespace limn::app {
class Json;  // in json_output.h
}

namespace limn::bench {

// Metal and glass of the first fourteen follow Fresnel's equations, smooth or with the same microfacets: limn and its
// peers can all express these scenes. The others are for limn alone.
std::vector<std::string> transport_scene_names();

// \throws ArgumentError for another name, FileError if the figures' data cannot be read
Figure make_transport_scene(const std::string& name);

// Returns camera, lights and objects as one JSON object, in world space and in double. apps/bench/peers writes the
// scenes of other renderers from it. The numbers come from the records that `compile` reads.
// \throws Error if no peer can express the scene
app::Json describe_scene(const Figure& figure);

}  // namespace limn::bench
