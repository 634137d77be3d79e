// From the described to the flat scene: the only room that sees both.
#pragma once

#include <span>

#include "flat/scene.h"
#include "limn/scene/scene.h"

namespace limn::compiler {

// Pure. \throws ArgumentError if an object contains itself, instances nest too deep, a medium's boundary contains a
// medium, or there are too many primitives
flat::Scene flatten(const limn::Scene& scene);

// Makes of it what flatten makes of its description with some objects moved.
// \throws ArgumentError, and does nothing, if there is no such object, it is no instance, it is moved twice, or its
// matrices are none for an Instance
void move(flat::Scene& scene, std::span<const MovedObject> moved);

}  // namespace limn::compiler
