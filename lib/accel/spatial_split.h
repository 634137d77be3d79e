// Splits by a plane that may cut boxes, so that what is in them stands on both sides (Stich, Friedrich, Dietrich:
// Spatial Splits in Bounding Volume Hierarchies, 2009). They are here because they take 5 to 8 % off what a ray is
// expected to cost in scenes of long or scattered triangles (docs/performance.md).
#pragma once

#include "accel/binning.h"

namespace limn::accel {

// Half the area that both sides of a split by centres have in common.
double overlap(const BuildPrimitive* primitives, const Range& range, const Split& split);

struct Cut {
    double cost = std::numeric_limits<double>::infinity();  // as that of a Split
    int axis = 0;
    float position = 0;
};

// The cheapest plane, by a sample.
Cut best_cut(const BuildPrimitive* primitives, const Range& range, std::uint32_t leaf_width, const Clip& clip);

// Copies what is below the plane to `lower` and what is above it to `upper`, each cut where it must be, or left whole
// on the side where that is cheaper. False, and nothing of use done, where that would not make both smaller, or take
// more room than there is.
bool cut(const BuildPrimitive* primitives, BuildPrimitive* to, const Range& range, const Cut& cut, const Clip& clip,
         Range& lower, Range& upper);

// Sets where both sides of a range stand, and moves the upper one there, so that each has its share of the room.
void share_room(BuildPrimitive* to, const Range& range, std::uint32_t lower_size, std::uint32_t upper_begin,
                std::uint32_t upper_size, Range& lower, Range& upper);

}  // namespace limn::accel
