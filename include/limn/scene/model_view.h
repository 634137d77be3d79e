/// \file
/// A scene and a camera for a model that has neither lights nor cameras.
#pragma once

#include <memory>
#include <optional>

#include "limn/scene/camera.h"
#include "limn/scene/scene.h"

namespace limn {

/// Options of view_model.
struct ViewOptions {
    double aspect_ratio = 1;                              ///< width over height of the picture
    Projection projection = Projection::perspective;      ///< projection of the camera
    Vec3 up{0, 1, 0};                                     ///< direction away from the ground; of any length but zero
    std::optional<Color> background{};                    ///< constant background; by default a sky
    bool ground = true;                                   ///< true if the model is on a ground
    std::shared_ptr<const EnvironmentMap> environment{};  ///< replaces the sky and the key light; null: none
};

/// A scene and its camera.
struct ModelView {
    Scene scene;    ///< its first objects are those of the model
    Camera camera;  ///< a camera that frames the model
};

/// Returns a scene with the model and a camera that frames it tightly.
///
/// - The model is on a ground. A square key light is above it, to the left and in front. The sky is bluish above and
///   dimmer below.
/// - The camera is a little above the model, at its front right: +x and +z if y is up.
/// - The first objects of the scene are those of the model, as Scene::add numbers them.
/// - All lengths are proportional to the size of the model. A model in other units gives the same picture.
///
/// \throws ArgumentError if the model has no triangles, the aspect ratio is not positive and finite, `up` is zero or
/// not finite, or both a background and an environment are given
ModelView view_model(const Model& model, const ViewOptions& options = {});

}  // namespace limn
