// Compiles the described scene to the flat scene. `flat` is the only room of lib/ that sees both.
#pragma once

#include <span>

#include "flat/scene.h"
#include "limn/scene/scene.h"

namespace limn::compiler {

// Returns the flat scene of a description. The function is pure.
// \throws ArgumentError if an object contains itself, instances nest too deep, a medium's boundary contains a medium,
// there are too many primitives, or the background is negative or not finite
flat::Scene flatten(const limn::Scene& scene);

// Moves instances of a flat scene. The scene becomes the same as if it had been flattened from a description with the
// instances at their new places.
// \throws ArgumentError if an object doesn't exist, isn't an instance or is moved twice, or if an Instance would reject
// its matrices. In these cases the scene is unchanged.
void move(flat::Scene& scene, std::span<const MovedObject> moved);

}  // namespace limn::compiler
