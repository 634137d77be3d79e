// The functions that add classes and functions to the module limn._limn. They must be called in this order, because a
// base class must be bound before the classes derived from it.
#pragma once

#include <nanobind/nanobind.h>

namespace limn::python {

void bind_textures(nanobind::module_& module);
void bind_materials(nanobind::module_& module);
void bind_shapes(nanobind::module_& module);
void bind_meshes(nanobind::module_& module);
void bind_lights(nanobind::module_& module);
void bind_scene(nanobind::module_& module);
void bind_images(nanobind::module_& module);
void bind_render(nanobind::module_& module);

}  // namespace limn::python
