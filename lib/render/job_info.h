#pragma once

#include "limn/query/compiled_scene.h"
#include "limn/render/film.h"
#include "limn/render/settings.h"

namespace limn::transport {

// What a render's film is of. \throws ArgumentError for impossible settings or an impossible camera, Error if a
// primitive has no material
FilmInfo film_info(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings);

}  // namespace limn::transport
