/// \file
/// The random table of Perlin noise.
#pragma once

#include <array>
#include <cstdint>

#include "limn/math/vec.h"

namespace limn {

/// The random table of Perlin noise: 256 unit gradients and three permutations of 0..255 (Perlin, An Image Synthesizer,
/// 1985). It is read-only after its construction and may be shared by pointer.
struct PerlinLattice {
    /// The gradients have unit length. Lattice point (x, y, z) has the gradient with the index perm_x[x] ^ perm_y[y] ^
    /// perm_z[z], where x, y and z are taken modulo 256.
    ///@{
    std::array<Vec3, 256> gradients;
    std::array<std::uint8_t, 256> perm_x, perm_y, perm_z;
    bool operator==(const PerlinLattice&) const = default;
    ///@}

    /// Returns the table of a seed. It is the same on every platform and with every compiler.
    static PerlinLattice from_seed(std::uint64_t seed);
};

}  // namespace limn
