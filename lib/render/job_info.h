#pragma once

#include <cmath>

#include "limn/query/compiled_scene.h"
#include "limn/render/film.h"
#include "limn/render/settings.h"

namespace limn::transport {

// Whether an error or a time can be asked for.
inline bool is_target(double value) { return value > 0 && std::isfinite(value); }

// What a render's film is of. \throws ArgumentError for impossible settings or an impossible camera, Error if a
// primitive has no material
FilmInfo film_info(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings);

}  // namespace limn::transport
