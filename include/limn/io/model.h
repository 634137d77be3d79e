/// \file
/// Models from files.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "limn/scene/model.h"

namespace limn {

/// What a reader puts where the files say nothing.
struct ModelOptions {
    /// For faces without a material; by default grey, Lambertian of albedo 0.5.
    std::shared_ptr<const Material> default_material{};
    /// Whether the images that materials name are read. Without them a material of an OBJ with map_Kd takes Kd, and
    /// without Kd (0.6, 0.6, 0.6); one of a glTF takes its factors.
    bool textures = true;
    /// In degrees: a mesh without normals gets those of smooth_normals. By default it stays flat.
    std::optional<double> crease{};
};

/// Reads a model, in any locale: Wavefront OBJ (load_obj), PLY, STL or glTF 2.0 (.gltf and .glb), told apart by their
/// contents; the name counts only for a damaged binary STL. docs/models.md says what materials become and what gives a
/// warning. Only regular files are read: no pipe, no device.
///
/// \throws FileError naming the file and, where there is one, the place in it: unreadable, no model (and what it
/// appears to be), damaged, no usable face
///
/// \throws ArgumentError if the crease angle is outside [0, 180]
Model load_model(const std::string& path, const ModelOptions& options = {});

/// The same from the bytes of a file, which messages call `path`; what it names is beside that, so with a name alone in
/// the current folder.
Model load_model_from_memory(std::span<const std::byte> bytes, const std::string& path,
                             const ModelOptions& options = {});

}  // namespace limn
