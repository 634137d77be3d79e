/// \file
/// The table that Perlin noise reads.
#pragma once

#include <array>
#include <cstdint>

#include "limn/core/vec.h"

namespace limn {

/// The random table behind Perlin noise: 256 unit gradients and three permutations of 0..255 (Perlin, An Image
/// Synthesizer, 1985). Immutable once made; share it by pointer.
struct PerlinLattice {
    /// Gradient i has unit length; lattice point (x, y, z) takes number perm_x[x] ^ perm_y[y] ^ perm_z[z], coordinates
    /// modulo 256.
    ///@{
    std::array<Vec3, 256> gradients;
    std::array<std::uint8_t, 256> perm_x, perm_y, perm_z;
    bool operator==(const PerlinLattice&) const = default;
    ///@}

    /// The same seed gives the same lattice on every platform and compiler.
    static PerlinLattice from_seed(std::uint64_t seed);
};

}  // namespace limn
