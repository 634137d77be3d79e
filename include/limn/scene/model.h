/// \file
/// The contents of a model file.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "limn/math/transform.h"
#include "limn/scene/camera.h"
#include "limn/scene/shape/mesh.h"

namespace limn {

/// A placement of a mesh.
struct ModelInstance {
    std::size_t mesh = 0;         ///< index into Model::meshes
    Transform world_from_mesh{};  ///< placement; not singular
    std::string name{};           ///< name of the glTF node; may be empty
};

/// A camera that the file describes.
struct ModelCamera {
    std::string name;  ///< may be empty
    Camera camera;     ///< its aspect ratio is unset if the file states none
};

/// A light without extent, as in glTF's KHR_lights_punctual. Scene::add turns it into a PointLight, SpotLight or
/// DirectionalLight and divides its intensity by 683 lm/W. Blender's importer and exporter use the same factor, and
/// leave the radiance of emissive materials as it is. Lights and emissive surfaces of a file therefore keep their
/// proportion.
struct ModelLight {
    /// The types of KHR_lights_punctual.
    enum class Kind { point, spot, directional };
    std::string name;              ///< may be empty
    Kind kind = Kind::point;       ///< decides which of the fields below are used
    Color intensity;               ///< point, spot: in cd; directional: illuminance in lx
    Point3 position;               ///< point, spot
    Vec3 direction{0, 0, -1};      ///< spot, directional: unit vector away from the light
    double inner_cone_angle = 0;   ///< spot: degrees from the axis; the intensity is full up to here
    double outer_cone_angle = 45;  ///< spot: degrees from the axis; the intensity is 0 beyond
};

/// A run of consecutive faces of an OBJ that have the same object and group names. It ends where the next run begins.
struct ModelPart {
    std::string object;          ///< name on the last line `o`; empty before the first
    std::string group;           ///< name on the last line `g` after that line; empty if there is none
    std::size_t first_face = 0;  ///< number of the first face, as Mesh::face counts them
};

/// The contents of a model file: meshes and their instances, materials, cameras and lights.
struct Model {
    /// The meshes. An OBJ, PLY or STL file has one. Mesh::face numbers the faces of the whole file, in its order.
    /// Material slot 0 is for faces without a material. Slot i + 1 is for materials[i].
    std::vector<std::shared_ptr<const Mesh>> meshes;
    std::vector<ModelInstance> instances;  ///< placements of the meshes
    std::vector<std::string> materials;    ///< names, in the order of the file; in an OBJ, of first use
    std::vector<ModelCamera> cameras;      ///< in the order of the file
    std::vector<ModelLight> lights;        ///< in the order of the file
    std::vector<ModelPart> parts;          ///< parts of an OBJ with names, in the order of the file; none is empty

    std::size_t vertices = 0;              ///< number of positions in the file; in an STL, of distinct ones
    std::size_t faces = 0;                 ///< number of faces in the file
    std::size_t dropped_faces = 0;         ///< faces left out: under three corners, no area, or too complicated to cut
    std::size_t degenerate_triangles = 0;  ///< triangles left out: of exactly zero area, which no ray can hit
    /// Messages about parts of the files that limn ignored or replaced: a missing MTL, a missing texture, an unknown
    /// material, unknown lines. Messages about missing MTLs come first. For each MTL, one message lists the words in
    /// its materials that limn doesn't use.
    std::vector<std::string> warnings;
    /// Paths of the files that were read, or could not be read: the model, the files that it names, their textures.
    std::vector<std::string> files;

    Box bounds() const;  ///< a box around all instances
    /// Returns the part that a face belongs to, or null if the face belongs to none. The pointer is valid until `parts`
    /// changes.
    const ModelPart* part_of(std::size_t face) const;
    /// Replaces every material that has the given name. The meshes become new objects, which share the arrays of the
    /// old ones. A scene to which the model was added before doesn't change.
    ///
    /// \throws ArgumentError if no material has the name
    void replace_material(const std::string& name, std::shared_ptr<const Material> material);
};

}  // namespace limn
