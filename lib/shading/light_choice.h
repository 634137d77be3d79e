// Which of many lights is sampled at each receiver: a descent of the tree of lights.
#pragma once

#include "shading/lights.h"

namespace limn::lights {

struct Choice {
    std::size_t rank = 0;
    double probability = 0;  // 0: none. A part of the tree was chosen in which no light is on the receiver's side
};

// Chooses a light for each receiver by a number in [0, 1). Each that is on the receiver's side has a positive
// probability. \pre there are lights
void choose(const flat::LightTable& lights, const Receivers& receivers, const Row& pick, Choice* choices);

// With which probability `choose` gives each rank.
void find_probability(const flat::LightTable& lights, const Receivers& receivers, const Row& rank, Row& probability);

}  // namespace limn::lights
