/// \file
/// The scenes of `./build.sh convergence`. They use only limn's public headers, the figures and the gallery.
#pragma once

#include <string>
#include <vector>

#include "figure.h"
#include "json_output.h"

namespace limn::bench {

// Returns the names of the scenes. limn and its peers can all express the first fourteen: their metal and glass follow
// Fresnel's equations and are smooth or have the same microfacets. Only limn renders the others.
std::vector<std::string> transport_scene_names();

// Returns the scene of a name. \throws ArgumentError for another name, FileError if the figures' data cannot be read
Figure make_transport_scene(const std::string& name);

// Returns camera, lights and objects as a JSON object, in world space and with the numbers that `compile` reads. The
// modules in apps/bench/peers make the peers' scenes from it. \throws Error if no peer can express the scene
app::Json describe_scene(const Figure& figure);

}  // namespace limn::bench
