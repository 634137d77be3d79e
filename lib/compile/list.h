#pragma once

#include "flat/scene.h"

namespace limn::compiler {

// Fills Scene::list if the scene is small and all its primitives can be told apart well in float. \pre the trees are
// built
void list_primitives(flat::Scene& scene);

}  // namespace limn::compiler
