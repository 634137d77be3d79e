/// \file
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "limn/shape/mesh.h"

namespace limn {

/// What was read from a model file.
struct Model {
    std::vector<std::shared_ptr<const Mesh>> meshes;  ///< an OBJ gives one; `Mesh::face` numbers its faces in file order
    std::size_t faces = 0;               ///< in the file
    std::size_t dropped_faces = 0;       ///< fewer than three corners, or no area
    std::size_t degenerate_triangles = 0;
    std::vector<std::string> warnings;   ///< a missing MTL or texture file, an unknown material, lines that were passed over

    Box bounds() const;
};

struct ObjOptions {
    /// For faces without a material; by default grey, Lambertian of albedo 0.5.
    std::shared_ptr<const Material> default_material;
};

/// Reads a Wavefront OBJ and its MTL. Decimals become the nearest float32. Polygons are cut by ear clipping. Materials:
///
/// | MTL | material |
/// |---|---|
/// | Ke not black | DiffuseLight(Ke) |
/// | d < 1 (or Tr > 0), or illum 4, 6, 7, 9 | Dielectric(Ni, or 1.5 where Ni <= 1) |
/// | illum 3, 5, 8, or Ks brighter than Kd | Metal(Ks, fuzz = sqrt(2 / (Ns + 2)), at most 1) |
/// | else map_Kd | Lambertian(image), decoded from sRGB by metadata, v upward, repeated |
/// | else | Lambertian(Kd) |
///
/// \throws FileError naming file and line: unreadable, no usable face, an index out of range, a coordinate that is not a
/// finite float32, a malformed number
Model load_obj(const std::string& path, const ObjOptions& options = {});

}  // namespace limn
