#pragma once

#include <cmath>

#include "limn/query/compiled_scene.h"
#include "limn/render/film.h"
#include "limn/render/settings.h"

namespace limn::transport {

// True if a value can be the target error or the time limit of a render.
inline bool is_target(double value) { return value > 0 && std::isfinite(value); }

// Returns the FilmInfo of a render. \throws ArgumentError for impossible settings, Error if a primitive has no material
FilmInfo film_info(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings);

}  // namespace limn::transport
