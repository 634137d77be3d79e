/// \file
/// Models from Wavefront files.
#pragma once

#include "limn/io/model.h"

namespace limn {

using ObjOptions = ModelOptions;  ///< what load_obj puts where the files say nothing

/// Reads a Wavefront OBJ and its MTL, in any locale; load_model does so, too. Decimals become the nearest float32.
/// Polygons are cut by ear clipping; one of many thousand corners that takes too long is dropped with a warning.
/// Vertices are those of the file unless faces name normals or texture coordinates: then one for each combination, and
/// a corner without a normal, or with one of length zero, gets its face's, one without a texture coordinate (0, 0).
///
/// What files say in odd ways: lines end in LF, CR LF or CR, and continue behind a backslash; a byte order mark is
/// skipped; '#' begins a comment. A name may hold blanks; a '#' behind a blank ends it, unless a digit follows
/// ("Material #25" is a name). mtllib may give one name or several; it is relative to the OBJ, pictures to the MTL. An
/// index may point forward. Groups become Model::parts. Weights and vertex colours are not used, nor are lines, points
/// and smoothing. Other unknown lines, the options of pictures and a second material of the same name are passed over
/// with a warning. Only regular files are read: no pipe, no device.
///
/// A material, its colours clamped to what they may have, becomes the first of these that fits; docs/models.md says
/// more: what index, roughness, Kd and Ks are, masks and bumps around the material, and what becomes a warning:
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
/// A material or picture that is missing or unreadable is replaced, with a warning: a material by the default one, a
/// picture by Kd or Ks, and without Kd by (0.6, 0.6, 0.6).
///
/// \throws FileError naming file and line: unreadable, no OBJ (and what it appears to be), no usable face, an index out
/// of range, a coordinate that is not a finite float32, a malformed number in the OBJ or the MTL
Model load_obj(const std::string& path, const ObjOptions& options = {});

}  // namespace limn
