#include "limn/scene/model.h"

#include <algorithm>

#include "limn/math/error.h"

namespace limn {

Box Model::bounds() const {
    Box box;
    for (const auto& [mesh, world_from_mesh, name] : instances) {
        const Box own = meshes[mesh]->bounds();
        box.extend(world_from_mesh == Transform{} ? own : transform_box(world_from_mesh, own));
    }
    return box;
}

const ModelPart* Model::part_of(std::size_t face) const {
    const auto after = std::ranges::upper_bound(parts, face, {}, &ModelPart::first_face);
    return after == parts.begin() ? nullptr : &*(after - 1);
}

void Model::replace_material(const std::string& name, std::shared_ptr<const Material> material) {
    std::vector<std::size_t> slots;
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (materials[i] == name) slots.push_back(i + 1);
    if (slots.empty()) throw ArgumentError("Model::replace_material: there is no material '" + name + "'");
    for (std::shared_ptr<const Mesh>& mesh : meshes) {
        std::vector<std::shared_ptr<const Material>> all = mesh->materials();
        for (const std::size_t slot : slots) all.at(slot) = material;
        mesh = std::make_shared<Mesh>(*mesh, std::move(all));
    }
}

}  // namespace limn
