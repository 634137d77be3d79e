// Sobol points in random order and with random digits: Owen's nested uniform scrambling (Randomly permuted (t,m,s)-nets
// and (t,s)-sequences, 1995). Hashes replace the stored permutations.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "math/rows.h"

namespace limn::sobol {

inline constexpr std::size_t kDimensions = 5;
// A sequence has 2^kIndexBits points.
inline constexpr int kIndexBits = 24;

// Returns the `base` that identifies sequence number `sequence` of a pixel: its numbers are scrambled independently of
// all others.
std::uint64_t base_of(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sequence);
// Returns the `index` that identifies a point of a sequence. \pre point < 2^kIndexBits
std::uint32_t index_of(std::uint32_t point);

// Returns the numbers in [0, 1) of one group of dimensions at a point. The groups of a sequence are scrambled
// independently of each other.
std::array<double, kDimensions> numbers_of(std::uint64_t base, std::uint32_t index, std::uint32_t group);

// Arrays of arguments of numbers_of(), with one element for each of `count` paths.
struct Points {
    std::size_t count;
    const std::uint64_t* base;
    const std::uint32_t* index;
    const std::uint32_t* group;
};
// Sets numbers[d][i] to number d of point i, for d < dimensions. May read up to kSlack elements behind `count`. With
// four dimensions it writes a fifth row too. \pre count <= kShaded, 1 <= dimensions <= 5
void draw(const Points& points, std::size_t dimensions, sampling::Row* numbers);

}  // namespace limn::sobol
