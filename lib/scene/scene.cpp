#include "limn/scene/scene.h"

#include "limn/core/error.h"
#include "limn/shape/instance.h"

namespace limn {

std::size_t Scene::add(std::shared_ptr<const Hittable> object) {
    if (!object) throw ArgumentError("Scene::add: the object must not be null");
    objects_.push_back(std::move(object));
    return objects_.size() - 1;
}

std::size_t Scene::add(const Model& model) {
    const std::size_t first = objects_.size();
    for (const ModelInstance& instance : model.instances) {
        const std::shared_ptr<const Mesh>& mesh = model.meshes.at(instance.mesh);
        if (instance.world_from_mesh == Transform{})
            add(mesh);
        else
            add(std::make_shared<Instance>(mesh, instance.world_from_mesh));
    }
    return first;
}

Box Scene::bounds() const {
    Box box;
    for (const auto& object : objects_) box.extend(object->bounds());
    return box;
}

}  // namespace limn
