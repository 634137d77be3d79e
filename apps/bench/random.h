/// \file
/// Numbers for scenes and rays: a function of seed, place and dimension, so that nothing depends on order.
#pragma once

#include <cstdint>

namespace limn::bench {

// Uniform in [0, 1). The mixer is SplitMix64's (Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators,
// 2014).
inline double random_number(std::uint64_t seed, std::uint64_t place, std::uint64_t dimension) {
    std::uint64_t x = seed + 0x9e3779b97f4a7c15 * (place * 64 + dimension + 1);
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

}  // namespace limn::bench
