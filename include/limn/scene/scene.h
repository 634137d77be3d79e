/// \file
/// What is described.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limn/core/transform.h"
#include "limn/scene/background.h"
#include "limn/scene/environment.h"
#include "limn/scene/lights.h"
#include "limn/scene/model.h"
#include "limn/shape/hittable.h"

namespace limn {

/// Where an object of a scene, an Instance, stands from now on.
struct MovedObject {
    std::size_t object = 0;               ///< its number, as Scene::add returned it
    Transform world_from_object{};        ///< as of an Instance
    std::optional<Transform> at_time1{};  ///< of one that moves while the shutter is open
};

/// A description: objects, lights and a background. Filling it is not thread-safe, reading it is.
class Scene {
public:
    Background background = Background::black();          ///< by default no light but that of lamps
    std::shared_ptr<const EnvironmentMap> environment{};  ///< in place of the background; null: the background counts
    std::string name = "scene";                           ///< goes into reports and picture headers

    /// Returns the object's number, counted from 0. \throws ArgumentError if it is null
    std::size_t add(std::shared_ptr<const Hittable> object);
    /// Adds each instance of the model as an object, and its lights. Returns the number of the first object; the others
    /// follow in order.
    std::size_t add(const Model& model);
    /// Adds a light that is no shape, as in `scene.add(PointLight{...})`. It is no object and has no number.
    ///
    /// \throws ArgumentError that names the field, for what limn/scene/lights.h does not allow
    void add(const LightSource& light);
    const std::vector<std::shared_ptr<const Hittable>>& objects() const { return objects_; }  ///< by number
    const std::vector<LightSource>& lights() const {
        return lights_;
    }                    ///< those that are no shapes, as they were added
    Box bounds() const;  ///< around all objects over the whole shutter

    /// Names of materials: of an object that Scene::add took from a model, Model::materials as it was then, otherwise
    /// null. \pre object < objects().size()
    const std::shared_ptr<const std::vector<std::string>>& material_names(std::size_t object) const {
        return material_names_[object];
    }

private:
    std::vector<std::shared_ptr<const Hittable>> objects_;
    std::vector<LightSource> lights_;
    std::vector<std::shared_ptr<const std::vector<std::string>>> material_names_;  // of each
};

}  // namespace limn
