// The tree by which one of many lights is chosen.
#pragma once

#include <cstdint>
#include <vector>

#include "flat/scene.h"
#include "limn/math/box.h"

namespace limn::compiler {

// A double cone that bounds the normals of planar lights and their opposites.
struct Cone {
    Vec3 axis;              // unit vector
    double cos_spread = 0;  // cosine of the half angle; 0 for any normals; flat::kNoNormals for spheres alone
};

// The bounds of one or several lights, by which a light is chosen.
struct LightBounds {
    Box box;  // while the shutter is open
    Cone cone;
    double strength = 0;  // sum of radiance * area; the area of a sphere is that of its disc, pi r^2
};

// A light as a leaf of the tree.
struct LightItem {
    flat::LightRef ref;
    static constexpr std::uint64_t kNoPrimitive = ~std::uint64_t{0};
    std::uint64_t number = 0;  // number of its primitive in the scene, or kNoPrimitive
    LightBounds bounds;
};

// Fills the table's ranks and nodes. Strengths are normalized to a sum of 1.
// \pre the table has its own lights, places and distant lights
void build_light_tree(std::vector<LightItem> items, flat::LightTable& table);

}  // namespace limn::compiler
