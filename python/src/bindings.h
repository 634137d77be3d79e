// The parts of the module, one for each subject, in the order in which types need each other.
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
