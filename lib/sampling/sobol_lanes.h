// Numbers of many paths' samplers at once.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sampling/rows.h"

namespace limn::sampling {

// Where each path stands in its sequence, see Sampler in render/sampler.h.
struct SobolLanes {
    alignas(64) std::uint64_t base[kShaded] = {};
    std::uint32_t index[kShaded] = {};  // of the point, its bits reversed
    std::uint32_t group[kShaded] = {};
};

// The first `dimensions` numbers of each of `count` paths' group, to the bits that sobol::number gives.
// \pre count <= kShaded, 1 <= dimensions <= 5
void draw_sobol(const SobolLanes& lanes, std::size_t count, std::size_t dimensions, Row* numbers);

}  // namespace limn::sampling
