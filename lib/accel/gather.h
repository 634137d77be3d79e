// The build primitives that a build begins with.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "accel/build_primitive.h"
#include "core/huge_pages.h"

namespace limn::accel {

using PrimitiveArray = std::unique_ptr<BuildPrimitive[], HugePageDeleter>;

// Room, not written to yet.
inline PrimitiveArray allocate_primitives(std::size_t size) {
    return PrimitiveArray(static_cast<BuildPrimitive*>(allocate_on_huge_pages(size * sizeof(BuildPrimitive))));
}

struct Gathered {
    PrimitiveArray primitives;             // of bounded boxes
    Range range;                           // all of them
    std::vector<std::uint32_t> unbounded;  // indices of the others
};

// Leaves out empty boxes. Counts boxes as unbounded too whose sides' sums or differences could overflow.
Gathered gather(std::span<const FloatBox> boxes);

// As range_over, in parallel.
Range range_over_many(const BuildPrimitive* primitives, std::uint32_t begin, std::uint32_t end);

}  // namespace limn::accel
