#include "limn/scene/scene.h"

#include "limn/math/error.h"
#include "limn/scene/shape/instance.h"
#include "scene/lights.h"

namespace limn {

namespace {

// Lumens per watt in the exporters of Khronos and Blender. They write the radiance of emissive materials unchanged, so
// lamps and emissive surfaces keep their proportion with this factor.
constexpr double kLumensPerWatt = 683;

// Returns a light of a model in radiometric units.
LightSource source_of(const ModelLight& light) {
    const Color color = light.intensity / kLumensPerWatt;
    switch (light.kind) {
        case ModelLight::Kind::point: return PointLight{light.position, color};
        case ModelLight::Kind::spot:
            return SpotLight{light.position, light.direction, color, light.inner_cone_angle, light.outer_cone_angle};
        case ModelLight::Kind::directional: break;
    }
    return DirectionalLight{light.direction, color};
}

}  // namespace

std::size_t Scene::add(std::shared_ptr<const Hittable> object) {
    if (!object) throw ArgumentError("Scene::add: the object must not be null");
    objects_.push_back(std::move(object));
    material_names_.emplace_back();
    return objects_.size() - 1;
}

std::size_t Scene::add(const Model& model) {
    const std::size_t first = objects_.size();
    const auto names = std::make_shared<const std::vector<std::string>>(model.materials);
    for (const ModelInstance& instance : model.instances) {
        const std::shared_ptr<const Mesh>& mesh = model.meshes.at(instance.mesh);
        if (instance.world_from_mesh == Transform{})
            add(mesh);
        else
            add(std::make_shared<Instance>(mesh, instance.world_from_mesh));
        material_names_.back() = names;
    }
    for (const ModelLight& light : model.lights) add(source_of(light));
    return first;
}

void Scene::add(const LightSource& light) {
    check(light);
    lights_.push_back(light);
}

Box Scene::bounds() const {
    Box box;
    for (const auto& object : objects_) box.extend(object->bounds());
    return box;
}

}  // namespace limn
