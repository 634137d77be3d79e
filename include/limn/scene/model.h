/// \file
/// What a model file holds.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "limn/core/transform.h"
#include "limn/scene/camera.h"
#include "limn/shape/mesh.h"

namespace limn {

/// A mesh where the file puts it.
struct ModelInstance {
    std::size_t mesh = 0;         ///< which of Model::meshes
    Transform world_from_mesh{};  ///< not singular
    std::string name{};           ///< of the node; may be empty
};

/// A camera that the file describes.
struct ModelCamera {
    std::string name;  ///< may be empty
    Camera camera;     ///< with an aspect ratio where the file states one
};

/// A light without a size, as glTF's KHR_lights_punctual has them. Scene::add makes a PointLight, SpotLight or
/// DirectionalLight of it, whose watts are lumens / 683: so do Blender's importer and exporter, which leave the
/// radiance of emissive materials as it is, so that lamps and emissive surfaces of a file keep their proportion.
struct ModelLight {
    /// The types of KHR_lights_punctual.
    enum class Kind { point, spot, directional };
    std::string name;              ///< may be empty
    Kind kind = Kind::point;       ///< which of the fields below have a meaning
    Color intensity;               ///< as the file states it: glTF in cd, of a directional light in lx
    Point3 position;               ///< of a point or spot light
    Vec3 direction{0, 0, -1};      ///< into which a spot or directional light shines, unit
    double inner_cone_angle = 0;   ///< of a spot light, in degrees from its axis: up to here all of its intensity
    double outer_cone_angle = 45;  ///< from here on none
};

/// A run of faces of an OBJ, up to the next: those behind its lines `o` and `g`.
struct ModelPart {
    std::string object;          ///< behind the last `o`; empty before the first
    std::string group;           ///< behind the last `g` since; empty if there is none
    std::size_t first_face = 0;  ///< counted as Mesh::face does
};

/// What was read from a model file.
struct Model {
    /// An OBJ, PLY or STL gives one. `Mesh::face` numbers the faces of the file, in its order. Material slot 0 is for
    /// faces without a material, slot i + 1 for materials[i].
    std::vector<std::shared_ptr<const Mesh>> meshes;
    std::vector<ModelInstance> instances;  ///< of the meshes
    std::vector<std::string> materials;    ///< their names, in the order of the file; of an OBJ, of their first use
    std::vector<ModelCamera> cameras;      ///< in the order of the file
    std::vector<ModelLight> lights;        ///< in the order of the file
    std::vector<ModelPart> parts;          ///< of an OBJ that names some, in the order of the file, none without faces

    std::size_t vertices = 0;              ///< positions in the file; of an STL those that differ
    std::size_t faces = 0;                 ///< in the file
    std::size_t dropped_faces = 0;         ///< fewer than three corners, no area, or too complicated to cut
    std::size_t degenerate_triangles = 0;  ///< of exactly zero area, which no ray can hit
    /// What in the files was not used as they say, a missing MTL first: a missing texture, an unknown material, lines
    /// that were passed over, and once for each MTL the words that its materials have and limn does not use.
    std::vector<std::string> warnings;
    std::vector<std::string> files;  ///< that were read, or tried: the model, what it names, textures

    Box bounds() const;  ///< around all instances
    /// The part that a face belongs to; null if it belongs to none.
    const ModelPart* part_of(std::size_t face) const;
    /// Gives what has the material of that name, or of those names, another one.
    ///
    /// \throws ArgumentError if no material has the name
    void replace_material(const std::string& name, std::shared_ptr<const Material> material);
};

}  // namespace limn
