/// \file
/// The light around a scene.
#pragma once

#include "limn/core/color.h"
#include "limn/core/vec.h"

namespace limn {

/// Radiance that arrives from infinitely far away, finite and not negative: `compile` refuses any other.
struct Background {
    Color bottom;  ///< for directions straight down
    Color top;     ///< for directions straight up

    static constexpr Background black() { return {}; }                       ///< none
    static constexpr Background constant(const Color& c) { return {c, c}; }  ///< from everywhere alike
    /// (1 - a) bottom + a top with a = (y + 1) / 2 of the unit direction.
    static constexpr Background gradient(const Color& bottom, const Color& top) { return {bottom, top}; }

    /// \param direction of any non-zero length
    Color radiance(const Vec3& direction) const;
};

}  // namespace limn
