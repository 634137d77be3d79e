/// \file
/// The scenes of the convergence report: what limn and its peers can all express. Metal is a mirror and glass follows
/// Fresnel's equations, because they share no other lobes.
#pragma once

#include <string>
#include <vector>

#include "figure.h"

namespace limn::bench {

// The names that make_transport_scene knows.
const std::vector<std::string>& transport_scene_names();

// \throws ArgumentError for another name, FileError if the figures' data cannot be read
Figure make_transport_scene(const std::string& name);

}  // namespace limn::bench
