/// \file
/// Reading models: OBJ, PLY, STL and glTF.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "limn/scene/model.h"

namespace limn {

/// Options for reading a model.
struct ModelOptions {
    /// The material of faces that have none. By default it is Lambertian with albedo 0.5.
    std::shared_ptr<const Material> default_material{};
    /// True to read the images that materials name. Without its image, a material of an OBJ takes Kd, or (0.6, 0.6,
    /// 0.6) if it has map_Kd but no Kd. A material of a glTF takes its factors.
    bool textures = true;
    /// The crease angle in degrees, 0 to 180: a mesh without normals gets normals from smooth_normals with this angle.
    /// By default a mesh without normals is shaded flat.
    std::optional<double> crease{};
};

/// Reads a model: Wavefront OBJ (see load_obj), PLY, STL or glTF 2.0 (.gltf and .glb). The contents of the file decide
/// the format. The name matters only for a damaged binary STL. The result does not depend on the locale. docs/models.md
/// says how materials are translated and what gives a warning. Only regular files are read, no pipes or devices.
///
/// \throws FileError that names the file and, if there is one, the place in it, if the file is unreadable or damaged,
/// isn't a model (the message says what it appears to be), or has no usable face
///
/// \throws ArgumentError if the crease angle is outside [0, 180]
Model load_model(const std::string& path, const ModelOptions& options = {});

/// Reads a model as load_model does, from the bytes of a file. Messages call it `path`. The files that the model names
/// are looked for in the folder of `path`; if `path` has no folder, in the current folder.
Model load_model_from_memory(std::span<const std::byte> bytes, const std::string& path,
                             const ModelOptions& options = {});

}  // namespace limn
