#include "limn/scene/scene.h"

#include "limn/core/error.h"

namespace limn {

std::size_t Scene::add(std::shared_ptr<const Hittable> object) {
    if (!object) throw ArgumentError("Scene::add: the object must not be null");
    objects_.push_back(std::move(object));
    return objects_.size() - 1;
}

Box Scene::bounds() const {
    Box box;
    for (const auto& object : objects_) box.extend(object->bounds());
    return box;
}

}  // namespace limn
