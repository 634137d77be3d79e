/// \file
/// The radiance that arrives from around a scene.
#pragma once

#include "limn/math/color.h"
#include "limn/math/vec.h"

namespace limn {

/// Radiance that arrives from infinitely far away. compile() throws ArgumentError if a component is negative or not
/// finite.
struct Background {
    Color bottom;  ///< radiance from straight below (-y), in W / (sr m^2)
    Color top;     ///< radiance from straight above (+y), in W / (sr m^2)

    static constexpr Background black() { return {}; }                       ///< no radiance
    static constexpr Background constant(const Color& c) { return {c, c}; }  ///< the same from all directions
    /// Makes a background of radiance (1 - a) bottom + a top. Here a = (y + 1) / 2, and y is the height of the unit
    /// direction.
    static constexpr Background gradient(const Color& bottom, const Color& top) { return {bottom, top}; }

    /// Returns the radiance from a direction.
    ///
    /// \param direction points away from the scene; of any length but zero
    Color radiance(const Vec3& direction) const;
};

}  // namespace limn
