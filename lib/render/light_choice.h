// Which of many lights is sampled at a receiver.
#pragma once

#include <cstddef>
#include <optional>

#include "flat/scene.h"
#include "limn/core/vec.h"
#include "shade/light_choice.h"

namespace limn::transport {

// What lights are chosen for: a point, and the side on which light counts.
struct Receiver {
    Point3 position;
    Vec3 normal;  // unit; zero where light counts from everywhere
};

struct LightChoice {
    std::size_t rank;
    double probability;
};

// Chooses a light by `pick` in [0, 1), about in proportion to what it would give if nothing were in the way. Nothing
// where no light is on the receiver's side, or a part of the tree was chosen in which none turned out to be; each that
// is has a positive probability. \pre there are lights
std::optional<LightChoice> choose_light(const flat::LightTable& lights, const Receiver& receiver, double pick);

// The same for each of `vertices`, by numbers[0]; a probability of 0 means none.
void choose_lights(const flat::LightTable& lights, shade::Lobe lobe, const shade::VertexLanes& vertices,
                   LightChoice* choices);

// With which probability choose_light gives this rank.
double probability_of(const flat::LightTable& lights, const Receiver& receiver, std::size_t rank);

}  // namespace limn::transport
