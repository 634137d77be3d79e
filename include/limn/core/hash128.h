/// \file
/// A digest, which stands for a large thing where only equality counts.
#pragma once

#include <array>
#include <cstdint>

namespace limn {

/// 128 bits of XXH3 (Collet, xxHash: https://xxhash.com): of different things never equal, except in an attack.
/// The same on every processor.
using Hash128 = std::array<std::uint64_t, 2>;

}  // namespace limn
