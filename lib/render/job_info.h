#pragma once

#include "limn/render/compiled_scene.h"
#include "limn/render/film.h"
#include "limn/render/settings.h"

namespace limn::tracing {

// What a render's film is of. \throws ArgumentError for impossible settings or an impossible camera, Error if a
// primitive has no material
FilmInfo film_info(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings);

}  // namespace limn::tracing
