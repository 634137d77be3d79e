/// \file
/// Scenes made by arithmetic, and those of files.
#pragma once

#include <string>
#include <vector>

#include "bench/geometry.h"

namespace limn::bench {

// The names that make_scene knows.
const std::vector<std::string>& scene_names();

// `scale` multiplies the number of primitives.
Geometry make_scene(const std::string& name, double scale);

// \throws FileError
Geometry load_scene(const std::string& path);

}  // namespace limn::bench
