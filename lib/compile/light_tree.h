#pragma once

#include <cstdint>
#include <vector>

#include "flat/scene.h"
#include "limn/core/box.h"

namespace limn::compiler {

// Bounds the directions of planes' normals and their opposites.
struct Cone {
    Vec3 axis;              // unit
    double cos_spread = 0;  // 0: any normals; flat::kNoNormals: of spheres alone
};

// What is known of a light, or of several, when one is chosen.
struct LightBounds {
    Box box;  // over the whole shutter
    Cone cone;
    double strength = 0;  // radiance times area, or of the disc that a sphere is seen as
};

struct LightItem {
    flat::LightRef ref;
    static constexpr std::uint64_t kNoPrimitive = ~std::uint64_t{0};
    std::uint64_t number = 0;  // of its primitive
    LightBounds bounds;
};

// Fills the table's ranks and nodes; places, own lights and distant ones are there already. The strengths are made to
// add up to 1.
void build_light_tree(std::vector<LightItem> items, flat::LightTable& table);

}  // namespace limn::compiler
