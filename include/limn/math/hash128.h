/// \file
/// A digest, to compare large data for equality.
#pragma once

#include <array>
#include <cstdint>

namespace limn {

/// A 128-bit digest by XXH3 (Collet, xxHash: https://xxhash.com). Digests of different data don't collide by accident;
/// they can be made to collide on purpose. A digest is the same on every processor.
using Hash128 = std::array<std::uint64_t, 2>;

}  // namespace limn
