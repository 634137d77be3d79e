// Conversion of arguments that are shapes, meshes or materials.
#pragma once

#include <memory>

#include "arguments.h"
#include "limn/math/box.h"
#include "limn/scene/material/material.h"
#include "limn/scene/shape/mesh.h"

namespace limn::python {

// Returns the material, or null if the argument is None.
std::shared_ptr<const Material> material_or_none(MaterialArgument argument, const char* name);
std::shared_ptr<const Hittable> shape_of(nb::handle object, const char* name);
// Returns the lower and the upper corner of a box, each as a tuple of three numbers.
nb::tuple corners(const Box& box);

// Returns a copy of the arrays of a mesh: vertices (n, 3) float32 and faces (m, 3) of an integer type.
MeshData mesh_data(ArrayArgument vertices, ArrayArgument faces);
// Returns a mesh. Throws a ValueError that names `faces` if no triangle has an area.
std::shared_ptr<const Mesh> make_mesh(MeshData data, std::vector<std::shared_ptr<const Material>> materials);

}  // namespace limn::python
