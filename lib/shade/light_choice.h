// The way down the tree of lights for many receivers at once.
#pragma once

#include "flat/lights.h"
#include "shade/lobes.h"

namespace limn::shade {

// Which lights a node stands for as one, so that the way down need not go on: it is farther than this many half
// diagonals, the lights' normals have at least this cosine with a common axis (or they are spheres) and its middle is
// before the receiver. Measured in the Cornell box: with 1e4 triangles as its lamp 2 takes a third less time per error
// than going down to the leaves, with 200 balls a twentieth; 1.5 to 5 are within 6 % of it.
inline constexpr double kAlikeSquared = 2.0 * 2.0, kAlikeSpread = 0.9;
// A number that was less than 1 stays so.
inline constexpr double kLargestPick = 1 - 0x1p-53;

// Where each receiver's way ended.
struct LightWays {
    std::uint32_t node[kShaded] = {}, begin[kShaded] = {};  // whose lights' ranks begin here
    Lane pick = {};                                         // what is left of the number, as good as a new one
    Lane probability = {};  // of having come there; 0 where no light is on the receiver's side
};

// By numbers[0] of the vertices, to the same bits as one by one: see render/light_choice.cpp.
// \param lights with at least two, and at most kMostNodes nodes
inline constexpr std::size_t kMostNodes = 1u << 27;
void descend_lights(const flat::LightTable& lights, Lobe lobe, const VertexLanes& vertices, LightWays& ways);

}  // namespace limn::shade
