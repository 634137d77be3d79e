// Where to cut a range in two: the surface-area heuristic over bins of centres (Wald, On Fast Construction of SAH-based
// Bounding Volume Hierarchies, 2007).
#pragma once

#include "accel/build_primitive.h"

namespace limn::accel {

struct Split {
    float cost = std::numeric_limits<float>::infinity();  // of both sides: area over the range's times leaf tests
    int axis = 0;
    float origin = 0, scale = 0, first_upper = 0;

    bool exists() const { return cost < std::numeric_limits<float>::infinity(); }
    // As Bins::add (binning.cpp) places it, in the same operations.
    bool is_lower(const BuildPrimitive& p) const {
        return ((p.lower[axis] + p.upper[axis]) - origin) * scale < first_upper;
    }
};

// The cheapest one. Where there is any, neither side is empty.
Split best_split(const BuildPrimitive* primitives, const Range& range, std::uint32_t leaf_width);

// Copies the range, to the same place elsewhere, so that what is below the split comes first. Returns where the upper
// side begins.
std::uint32_t partition(const BuildPrimitive* from, BuildPrimitive* to, const Range& range, const Split& split);

}  // namespace limn::accel
