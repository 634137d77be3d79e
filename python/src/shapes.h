// Shapes and their materials as arguments.
#pragma once

#include <memory>

#include "arguments.h"
#include "limn/core/box.h"
#include "limn/material/material.h"
#include "limn/shape/mesh.h"

namespace limn::python {

std::shared_ptr<const Material> material_or_none(MaterialArgument argument, const char* name);
std::shared_ptr<const Hittable> shape_of(nb::handle object, const char* name);
nb::tuple corners(const Box& box);  // the lower one, the upper one

// The arrays of a mesh: (n, 3) float32 and (m, 3) of whole numbers.
MeshData mesh_data(ArrayArgument vertices, ArrayArgument faces);
std::shared_ptr<const Mesh> make_mesh(MeshData data, std::vector<std::shared_ptr<const Material>> materials);

}  // namespace limn::python
