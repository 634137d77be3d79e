#pragma once

#include <span>
#include <vector>

#include "flat/scene.h"

namespace limn::compiler {

// Fills Scene::list with all primitives if the scene is small and all can be told apart well in float. False if not.
// \pre the root's extent and scale are set
bool list_all(flat::Scene& scene);

// A primitive of the root, in no mesh.
struct Candidate {
    flat::Reference reference;
    Box box{};
    double packed_error = 0;  // how far its numbers move when they are packed as float
    std::uint32_t index = 0;  // in the tree
};

// Fills Scene::list with the candidates that are so large beside the rest that most rays would come upon them in a
// tree, and says which. `others`: bounds of what is no candidate. \pre the same
std::vector<bool> list_large(flat::Scene& scene, std::span<const Candidate> candidates, const Box& others);

}  // namespace limn::compiler
