// Sobol points whose order and digits are scrambled by hashing: Owen's nested uniform scrambling (Randomly permuted
// (t,m,s)-nets and (t,s)-sequences, 1995) without storing any permutation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sampling/rows.h"

namespace limn::sobol {

inline constexpr std::size_t kDimensions = 5;
// Points of one randomisation.
inline constexpr int kIndexBits = 24;

// Where the samples of a pixel stand in its sequence number `sequence`, and its point: see numbers_of.
std::uint64_t base_of(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sequence);
std::uint32_t index_of(std::uint32_t point);

// The numbers of a group of dimensions, in [0, 1).
std::array<double, kDimensions> numbers_of(std::uint64_t base, std::uint32_t index, std::uint32_t group);

// The same for many paths.
struct Points {
    std::size_t count;
    const std::uint64_t* base;
    const std::uint32_t* index;
    const std::uint32_t* group;
};
// The first `dimensions` numbers of each. Reads up to kSlack points more. \pre count <= kShaded, 1 <= dimensions <= 5
void draw(const Points& points, std::size_t dimensions, sampling::Row* numbers);

}  // namespace limn::sobol
