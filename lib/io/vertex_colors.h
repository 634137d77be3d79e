#pragma once

#include <memory>
#include <vector>

#include "limn/scene/material/material.h"
#include "limn/scene/shape/mesh.h"

namespace limn {

// Converts linear colours of vertices into a texture, and returns a diffuse material with it for slot 1. Each
// combination of three colours that a triangle has becomes four texels. A bilinear look-up between them interpolates
// like the barycentric weights of the corners.
//
// Changes the mesh: each triangle gets vertices of its own, the texture coordinates are replaced, and all material
// slots become 1.
std::shared_ptr<const Material> paint(MeshData& mesh, const std::vector<Float3>& colors);

}  // namespace limn
