// Chooses the primitives of Scene::list.
#pragma once

#include <span>
#include <vector>

#include "flat/scene.h"

namespace limn::compiler {

// Fills Scene::list with all primitives if the scene is small and float is precise enough for each of them. Otherwise
// returns false. \pre the root's extent and scale are set
bool list_all(flat::Scene& scene);

// A primitive or instance of the root BLAS. Triangles of meshes aren't candidates.
struct Candidate {
    flat::Reference reference;
    Box box{};
    double packed_error = 0;  // error of rounding its numbers to float
    std::uint32_t index = 0;  // index of its box in the tree
};

// Fills Scene::list with the candidates that are so large compared with the rest that most rays would test them in a
// tree anyway. Returns a flag for each candidate, true if it's listed. `others` bounds the primitives that aren't
// candidates. \pre the root's extent and scale are set
std::vector<bool> list_large(flat::Scene& scene, std::span<const Candidate> candidates, const Box& others);

}  // namespace limn::compiler
