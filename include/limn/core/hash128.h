/// \file
/// What stands for a large thing where only its equality counts.
#pragma once

#include <array>
#include <cstdint>

namespace limn {

/// 128 bits of XXH3 (Collet, xxHash: https://xxhash.com): of different things they are, but for attacks, never equal.
/// The same on every processor.
using Hash128 = std::array<std::uint64_t, 2>;

}  // namespace limn
