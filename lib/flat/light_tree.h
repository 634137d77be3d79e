// The tree by which one of many lights is chosen.
#pragma once

#include <cstdint>
#include <vector>

#include "flat/light_table.h"

namespace limn::compiler {

// A light as a leaf of the tree.
struct LightItem {
    static constexpr std::uint64_t kNoPrimitive = ~std::uint64_t{0};
    flat::LightRef ref;
    std::uint64_t number = 0;  // number of its primitive in the scene, or kNoPrimitive
    flat::LightBounds bounds;
};

// Fills the table's ranks and nodes. Strengths are normalized to a sum of 1.
// \pre the table has its own lights, places and distant lights
void build_light_tree(std::vector<LightItem> items, flat::LightTable& table);

}  // namespace limn::compiler
