// Packs a tree into the tables of the flat scene.
#pragma once

#include <span>

#include "flat/scene.h"
#include "geometry/bvh/wide_bvh.h"

namespace limn::compiler {

// Moves the nodes of the tree to the scene and writes the blocks of its leaves, with the primitives of a leaf sorted by
// kind. `boxes` are those that the tree was built from, and `references` are their primitives. Returns the root.
// \throws ArgumentError if there are too many primitives
flat::Child pack_tree(accel::WideBvh bvh, std::span<const accel::FloatBox> boxes,
                      std::span<const flat::Reference> references, flat::Scene& scene);

}  // namespace limn::compiler
