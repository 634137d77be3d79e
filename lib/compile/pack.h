#pragma once

#include <span>

#include "accel/wide_bvh.h"
#include "flat/scene.h"

namespace limn::compiler {

// Moves the tree and the blocks of its leaves to the scene; the root. `references`: what the boxes were made from.
// The primitives of a leaf are sorted by kind.
flat::Child pack_tree(accel::WideBvh bvh, std::span<const accel::FloatBox> boxes,
                      std::span<const flat::Reference> references, flat::Scene& scene);

}  // namespace limn::compiler
