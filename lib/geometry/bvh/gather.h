// Makes the array of build primitives that the build of a tree starts from.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geometry/bvh/build_primitive.h"
#include "math/system/huge_pages.h"

namespace limn::accel {

using PrimitiveArray = std::unique_ptr<BuildPrimitive[], HugePageDeleter>;

// Returns uninitialised memory for `size` build primitives.
inline PrimitiveArray allocate_primitives(std::size_t size) {
    return PrimitiveArray(static_cast<BuildPrimitive*>(allocate_on_huge_pages(size * sizeof(BuildPrimitive))));
}

struct Gathered {
    PrimitiveArray primitives;             // one for each bounded box
    Range range;                           // covers all of `primitives`
    std::vector<std::uint32_t> unbounded;  // indices of the unbounded boxes
};

// Sorts the boxes into bounded and unbounded ones, both in their original order, and drops empty boxes. A box counts as
// unbounded if the sum or difference of two of its coordinates could overflow.
Gathered gather(std::span<const FloatBox> boxes);

// Returns the same as range_over(), computed in parallel.
Range range_over_many(const BuildPrimitive* primitives, std::uint32_t begin, std::uint32_t end);

}  // namespace limn::accel
