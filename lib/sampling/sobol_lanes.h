// Numbers of many paths' samplers at once.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sampling/rows.h"

namespace limn::sampling {

// Where each of `count` paths stands in its sequence, see Sampler in render/sampler.h.
struct SobolPoints {
    std::size_t count;
    const std::uint64_t* base;
    const std::uint32_t* index;  // of the point, its bits reversed
    const std::uint32_t* group;
};

// The first `dimensions` numbers of each path's group, to the bits that sobol::number gives. Reads up to kSlack points
// more. \pre count <= kShaded, 1 <= dimensions <= 5
void draw_sobol(const SobolPoints& points, std::size_t dimensions, Row* numbers);

}  // namespace limn::sampling
