#pragma once

#include "limn/query/compiled_scene.h"
#include "limn/render/film.h"
#include "limn/render/settings.h"

namespace limn::transport {

// What a render's film is of. \throws ArgumentError for impossible settings or an impossible camera, Error if a
// primitive has no material
FilmInfo film_info(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings);

// Whether the crop window, if there is one, holds pixels, all of the picture.
bool is_window(const FilmInfo& info);

}  // namespace limn::transport
