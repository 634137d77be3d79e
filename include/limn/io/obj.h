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
    /// An OBJ gives one; `Mesh::face` numbers its faces in file order.
    std::vector<std::shared_ptr<const Mesh>> meshes;
    std::size_t faces = 0;          ///< in the file
    std::size_t dropped_faces = 0;  ///< fewer than three corners, or no area
    std::size_t degenerate_triangles = 0;
    /// A missing MTL or texture file, an unknown material, lines that were passed over.
    std::vector<std::string> warnings;

    Box bounds() const;
};

struct ObjOptions {
    /// For faces without a material; by default grey, Lambertian of albedo 0.5.
    std::shared_ptr<const Material> default_material;
};

/// Reads a Wavefront OBJ and its MTL, in any locale. Decimals become the nearest float32. Polygons are cut by ear
/// clipping; one of many thousand corners that takes too long is dropped with a warning. Vertices are those of the file
/// unless faces name normals or texture coordinates: then one for each combination, and a corner without a normal, or
/// with one of length zero, gets its face's, one without a texture coordinate (0, 0). Materials:
///
/// | MTL | material |
/// |---|---|
/// | Ke not black | DiffuseLight(Ke) |
/// | d < 1 (or Tr > 0), or illum 4, 6, 7, 9 | Dielectric(Ni, or 1.5 where Ni <= 1) |
/// | illum 3, 5, 8, or Ks brighter than Kd | Metal(Ks, fuzz = sqrt(2 / (Ns + 2)), at most 1) |
/// | else map_Kd | Lambertian(image), decoded from sRGB by metadata, v upward, repeated |
/// | else | Lambertian(Kd) |
///
/// Colours are clamped to what the material may have. mtllib is relative to the OBJ, map_Kd to the MTL.
///
/// \throws FileError naming file and line: unreadable, no usable face, an index out of range, a coordinate that is not
/// a finite float32, a malformed number
Model load_obj(const std::string& path, const ObjOptions& options = {});

}  // namespace limn
