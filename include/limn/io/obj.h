/// \file
/// Reading Wavefront OBJ models.
#pragma once

#include "limn/io/model.h"

namespace limn {

using ObjOptions = ModelOptions;  ///< options of load_obj

/// Reads a Wavefront OBJ and its MTL. load_model reads them too. The result does not depend on the locale. Only regular
/// files are read, no pipes or devices.
///
/// **Geometry.**
/// - Decimals become the nearest float32.
/// - Polygons are cut by ear clipping. A polygon with many thousand corners is dropped with a warning if cutting it
///   takes too long.
/// - If no face names normals or texture coordinates, the mesh has the vertices of the file. Otherwise it has a vertex
///   for each combination of position, normal and texture coordinate that occurs. A corner without a normal, or with a
///   normal of length zero, gets the normal of its face. A corner without a texture coordinate gets (0, 0).
/// - Indices may refer to elements further down in the file.
/// - Groups become Model::parts.
/// - Weights, vertex colours, lines, points and smoothing groups are not used.
///
/// **Text.**
/// - A line ends in LF, CR LF or CR. A backslash at its end continues it.
/// - A byte order mark is skipped. '#' begins a comment.
/// - A name may contain blanks. A '#' after a blank ends the name, unless a digit follows: "Material #25" is a name.
/// - mtllib may give one name or several. They are relative to the OBJ, and pictures are relative to the MTL.
/// - Unknown lines, options of pictures other than -bm, and a second material of the same name are skipped with a
///   warning.
///
/// **Materials.** Colours are clamped to the range that materials allow. The first row that fits decides.
/// docs/models.md defines index, roughness, Kd and Ks, and describes masks, bumps and warnings.
///
/// | MTL | material |
/// |---|---|
/// | Ke not black | DiffuseLight(Ke) |
/// | illum 4, 6, 7, 9, no map_Kd, no map_d | Dielectric(index), with Pr RoughDielectric |
/// | Pm | MetallicRoughness(Kd, Pm, roughness); Plastic at 0, RoughConductor at 1 |
/// | illum 0, 1, 10, or Ks black and no map_Ks | Lambertian(Kd) |
/// | illum 3, 5, 8, or no illum and Ks brighter than Kd; no map_Kd | RoughConductor(Ks, roughness) |
/// | else | Plastic(Kd, roughness, index, Ks) |
///
/// If a material is missing or unreadable, the default one is used, with a warning. If a picture is missing or
/// unreadable, Kd or Ks is used, with a warning, and (0.6, 0.6, 0.6) if there is no Kd.
///
/// \throws FileError that names the file and, if there is one, the line, if
/// - the file is unreadable or isn't an OBJ (the message says what it appears to be),
/// - it has no usable face,
/// - an index is out of range,
/// - a coordinate is not a finite float32,
/// - the OBJ or the MTL has a malformed number.
///
/// \throws ArgumentError if the crease angle is outside [0, 180]
Model load_obj(const std::string& path, const ObjOptions& options = {});

}  // namespace limn
