#pragma once

#include <cstdint>
#include <vector>

#include "limn/core/vec.h"

namespace limn {

// For each vertex a number that it has in common with those at the same position, and with no others.
std::vector<std::uint32_t> position_numbers(const std::vector<Float3>& vertices);

}  // namespace limn
