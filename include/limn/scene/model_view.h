/// \file
/// A picture of a model that says nothing of light and camera.
#pragma once

#include <memory>
#include <optional>

#include "limn/scene/camera.h"
#include "limn/scene/scene.h"

namespace limn {

/// How view_model shows a model.
struct ViewOptions {
    double aspect_ratio = 1;                              ///< width over height of the picture
    Projection projection = Projection::perspective;      ///< of the camera
    Vec3 up{0, 1, 0};                                     ///< away from the ground; of any length but zero
    std::optional<Color> background{};                    ///< constant, seen and as light; by default a sky
    bool ground = true;                                   ///< whether the model stands on something
    std::shared_ptr<const EnvironmentMap> environment{};  ///< in place of the sky and the key light; null: none
};

/// A scene, and the camera for it.
struct ModelView {
    Scene scene;    ///< the model first
    Camera camera;  ///< that frames it
};

/// The model on a ground, under a square key light to the upper left front and a sky, bluish above and dimmer below.
/// The camera is at the front right (+x, +z where y is up), a little above, and has the model tightly in the picture.
/// The scene's first objects are the model's, as Scene::add numbers them. Everything goes with the size of the model,
/// so that one in other units gives the same picture.
///
/// \throws ArgumentError if the model has no triangles, the ratio is not positive and finite, `up` is zero or not
/// finite, or there is both a background and an environment
ModelView view_model(const Model& model, const ViewOptions& options = {});

}  // namespace limn
