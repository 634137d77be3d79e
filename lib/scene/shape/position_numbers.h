// Identifies the vertices of a mesh that are at the same position.
#pragma once

#include <cstdint>
#include <vector>

#include "limn/math/vec.h"

namespace limn {

// Returns a number for each vertex. Two vertices have the same number if and only if they are at the same position.
std::vector<std::uint32_t> position_numbers(const std::vector<Float3>& vertices);

}  // namespace limn
