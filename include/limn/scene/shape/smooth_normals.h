/// \file
/// Vertex normals for meshes without normals.
#pragma once

#include "limn/scene/shape/mesh.h"

namespace limn {

/// Returns the mesh with new vertex normals, which replace those of `data`.
///
/// - An edge is smooth if exactly two triangles share it and the angle between their normals is below the crease angle.
///   All other edges are creases.
/// - The normal of a corner is the mean of the normals of the triangles around it that are connected by smooth edges,
///   weighted by their angles at the corner (Thürmer and Wüthrich, Computing Vertex Normals from Polygonal Facets,
///   1998).
/// - A vertex is split if its corners have different normals. A vertex that no triangle uses is removed.
///
/// \param crease_degrees crease angle, in [0, 180] degrees; 180 smooths every edge of two triangles that aren't folded
/// onto each other
///
/// \throws ArgumentError if the angle is outside [0, 180], a triangle refers to a vertex that doesn't exist, or the
/// length of `uvs`, `material_slots` or `faces` is neither 0 nor that of the vertices or triangles
MeshData smooth_normals(const MeshData& data, double crease_degrees);

}  // namespace limn
