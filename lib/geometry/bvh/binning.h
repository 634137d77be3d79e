// Splits a range in two by the surface-area heuristic over bins of centres (Wald, On Fast Construction of SAH-based
// Bounding Volume Hierarchies, 2007).
#pragma once

#include "geometry/bvh/build_primitive.h"

namespace limn::accel {

// A split of a range at the boundary between two bins along one axis. The bin of a primitive is
// (2 * centre - origin) * scale, rounded down.
struct Split {
    // The sum over both sides of (area of the side / area of the range) * number of leaf tests. Infinite if there is no
    // split.
    float cost = std::numeric_limits<float>::infinity();
    int axis = 0;
    float origin = 0, scale = 0;
    float first_upper = 0;  // the first bin of the upper side

    bool exists() const { return cost < std::numeric_limits<float>::infinity(); }
    // Uses the same operations as Bins::add (binning.cpp), so both round alike.
    bool is_lower(const BuildPrimitive& p) const {
        return ((p.lower[axis] + p.upper[axis]) - origin) * scale < first_upper;
    }
};

// Returns the cheapest split. If it exists, neither of its sides is empty.
Split best_split(const BuildPrimitive* primitives, const Range& range, std::uint32_t leaf_width);

// Copies the primitives of the range from `from` to the same rows of `to`, those of the lower side first. Returns the
// row at which the upper side begins.
std::uint32_t partition(const BuildPrimitive* from, BuildPrimitive* to, const Range& range, const Split& split);

}  // namespace limn::accel
