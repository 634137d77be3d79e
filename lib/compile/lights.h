#pragma once

#include "flat/scene.h"

namespace limn::compiler {

// Fills scene.lights with every emitter that can be sampled: triangles, quads and spheres of a diffuse light, not under
// a moving instance, spheres not under one that bends them, none with a foreign texture. What is left out is found by
// scattering alone.
void collect_lights(flat::Scene& scene);

}  // namespace limn::compiler
