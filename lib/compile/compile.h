// From the described to the flat scene: the only room that sees both.
#pragma once

#include "flat/scene.h"
#include "limn/scene/scene.h"

namespace limn::compiler {

// Pure. \throws ArgumentError if an object contains itself, instances nest too deep, a medium's boundary contains a
// medium, or there are too many primitives
flat::Scene flatten(const limn::Scene& scene);

}  // namespace limn::compiler
