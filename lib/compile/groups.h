#pragma once

#include "flat/scene.h"

namespace limn::compiler {

// Builds the tree of every group. \pre the tables and the groups' ranges are filled
void build_trees(flat::Scene& scene);

// Lists every medium where instances put it. \pre the trees are built
void place_media(flat::Scene& scene);

}  // namespace limn::compiler
