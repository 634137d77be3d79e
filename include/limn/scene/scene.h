/// \file
/// The description of a scene, which compile() takes.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limn/math/transform.h"
#include "limn/scene/background.h"
#include "limn/scene/environment.h"
#include "limn/scene/lights.h"
#include "limn/scene/model.h"
#include "limn/scene/shape/hittable.h"

namespace limn {

/// A new placement of an object of a scene, for recompile(). The object must be an Instance.
struct MovedObject {
    std::size_t object = 0;               ///< number of the object, as Scene::add returned it
    Transform world_from_object{};        ///< placement, as that of an Instance; at time 0 if the object moves
    std::optional<Transform> at_time1{};  ///< placement at time 1; unset if the object doesn't move
};

/// A description of a scene: objects, lights and a background. Concurrent reads are safe. `add` is not thread-safe.
class Scene {
public:
    Background background = Background::black();          ///< radiance from infinitely far away
    std::shared_ptr<const EnvironmentMap> environment{};  ///< replaces the background; null: none
    std::string name = "scene";                           ///< name in reports and picture headers

    /// Adds an object. Returns its number, counted from 0.
    ///
    /// \throws ArgumentError if the object is null
    std::size_t add(std::shared_ptr<const Hittable> object);
    /// Adds each instance of the model as an object, and adds its lights. Returns the number of the first object. The
    /// others follow in order.
    ///
    /// \throws ArgumentError if an instance has a singular matrix, or a light has a field outside its range
    std::size_t add(const Model& model);
    /// Adds a light that isn't a shape, as in `scene.add(PointLight{...})`. A light isn't an object and has no number.
    ///
    /// \throws ArgumentError if a field is outside the range that limn/scene/lights.h states; the message names the
    /// field
    void add(const LightSource& light);
    const std::vector<std::shared_ptr<const Hittable>>& objects() const { return objects_; }  ///< objects by number
    const std::vector<LightSource>& lights() const { return lights_; }  ///< lights that aren't shapes, in order
    Box bounds() const;  ///< a box around all objects at all times from 0 to 1

    /// Returns Model::materials of the model that an object was added with, as they were then. Returns null if the
    /// object was not added with a model. \pre object < objects().size()
    const std::shared_ptr<const std::vector<std::string>>& material_names(std::size_t object) const {
        return material_names_[object];
    }

private:
    std::vector<std::shared_ptr<const Hittable>> objects_;
    std::vector<LightSource> lights_;
    std::vector<std::shared_ptr<const std::vector<std::string>>> material_names_;  // of each object; may be null
};

}  // namespace limn
