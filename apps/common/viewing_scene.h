/// \file
#pragma once

#include "limn/scene/scene.h"

namespace limn::app {

/// A model under the default light: a sky, bluish white above and dimmer below, and a square key light to the upper
/// left front as `frame_box` sees the model, outside that picture. Place and size of the light go with the model's
/// bounding box, so that a model in other units gives the same picture.
Scene make_viewing_scene(const Model& model);

}  // namespace limn::app
