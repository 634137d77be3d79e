/// \file
/// Normals for meshes that have none.
#pragma once

#include "limn/shape/mesh.h"

namespace limn {

/// Gives a mesh normals that are interpolated across edges whose two triangles turn by less than the crease angle, and
/// break at sharper ones, at borders and where more than two triangles meet. The normal of a corner is the mean of the
/// triangles around it that it is joined to, weighed by their angles there (Thürmer and Wüthrich, Computing Vertex
/// Normals from Polygonal Facets, 1998). Vertices are split where their corners differ; those that no triangle uses are
/// left out. What `data` has as normals is replaced.
///
/// \param crease_degrees in [0, 180]; 180 smooths everything but borders
///
/// \throws ArgumentError for another angle, a triangle that refers to a vertex that is not there, or `uvs`,
/// `material_slots` or `faces` of another length than the vertices or triangles that they belong to
MeshData smooth_normals(const MeshData& data, double crease_degrees);

}  // namespace limn
