/// \file
/// Models from Wavefront files.
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
    std::size_t vertices = 0;              ///< positions in the file, lines with v
    std::size_t faces = 0;                 ///< in the file
    std::size_t dropped_faces = 0;         ///< fewer than three corners, or no area
    std::size_t degenerate_triangles = 0;  ///< of exactly zero area, which no ray can hit
    std::vector<std::string> materials;    ///< the names that its usemtl lines give, in the order of their first use
    /// What in the files was not used as they say, a missing MTL first: a missing texture, an unknown material, lines
    /// that were passed over, and once for each MTL the words that its materials have and limn does not use.
    std::vector<std::string> warnings;
    std::vector<std::string> files;  ///< that were read, or tried: the model, its MTL files, their textures

    Box bounds() const;  ///< around all meshes
};

/// What load_obj puts where the files say nothing.
struct ObjOptions {
    /// For faces without a material; by default grey, Lambertian of albedo 0.5.
    std::shared_ptr<const Material> default_material{};
    /// Whether the images that materials name are read. Without them a material with map_Kd takes Kd, and without Kd
    /// (0.6, 0.6, 0.6).
    bool textures = true;
};

/// Reads a Wavefront OBJ and its MTL, in any locale. Decimals become the nearest float32. Polygons are cut by ear
/// clipping; one of many thousand corners that takes too long is dropped with a warning. Vertices are those of the file
/// unless faces name normals or texture coordinates: then one for each combination, and a corner without a normal, or
/// with one of length zero, gets its face's, one without a texture coordinate (0, 0).
///
/// What files say in odd ways: lines end in LF, CR LF or CR, and continue behind a backslash; a byte order mark is
/// skipped; '#' begins a comment. A name may hold blanks; a '#' behind a blank ends it, unless a digit follows
/// ("Material #25" is a name). mtllib may give one name or several; it is relative to the OBJ, map_Kd to the MTL. An
/// index may point forward. Weights and vertex colours are not used, nor are lines, points, groups and smoothing. Other
/// unknown lines, the options of map_Kd and a second material of the same name are passed over with a warning. Only
/// regular files are read: no pipe, no device.
///
/// A material, its colours clamped to what they may have, becomes the first of these that fits; docs/models.md says
/// more, and what becomes a warning:
///
/// | MTL | material |
/// |---|---|
/// | Ke not black | DiffuseLight(Ke) |
/// | map_Kd | Lambertian(image), decoded from sRGB by metadata, v upward, repeated |
/// | illum 3, 5, 8, Ks not black | Metal(Ks, fuzz = sqrt(2 / (Ns + 2)), at most 1) |
/// | illum 4, 6, 7, 9 | Dielectric(Ni, or 1.5 where Ni <= 1) |
/// | no illum, d < 1 (or Tr > 0) | Dielectric, as above |
/// | no illum, Ks brighter than Kd | Metal, as above |
/// | else | Lambertian(Kd) |
///
/// A material or picture that is missing or unreadable is replaced, with a warning: a material by the default one, a
/// picture by Kd, and without Kd by (0.6, 0.6, 0.6).
///
/// \throws FileError naming file and line: unreadable, no OBJ (and what it appears to be), no usable face, an index out
/// of range, a coordinate that is not a finite float32, a malformed number in the OBJ or the MTL
Model load_obj(const std::string& path, const ObjOptions& options = {});

}  // namespace limn
