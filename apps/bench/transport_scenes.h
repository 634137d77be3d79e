/// \file
/// The scenes of the convergence report: what limn and its peers can all express. Metal and glass follow Fresnel's
/// equations, smooth or with the same microfacets.
#pragma once

#include <string>
#include <vector>

#include "figure.h"

namespace limn::bench {

// The names that make_transport_scene knows.
const std::vector<std::string>& transport_scene_names();

// The first of them, with which limn's estimate of its error is measured too (promise.h).
const std::vector<std::string>& promised_scene_names();

// \throws ArgumentError for another name, FileError if the figures' data cannot be read
Figure make_transport_scene(const std::string& name);

}  // namespace limn::bench
