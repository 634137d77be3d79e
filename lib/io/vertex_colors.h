#pragma once

#include <memory>
#include <vector>

#include "limn/material/material.h"
#include "limn/shape/mesh.h"

namespace limn {

/// Colours of vertices, linear, as a texture: each three that a triangle has are four texels, between which bilinear
/// look-ups interpolate as weights of the corners do. Gives the mesh texture coordinates in place of those that it has,
/// vertices of their own for each triangle, and material slot 1, for which the diffuse material is.
std::shared_ptr<const Material> paint(MeshData& mesh, const std::vector<Float3>& colors);

}  // namespace limn
