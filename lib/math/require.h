// Checks of arguments that several rooms share.
#pragma once

#include <string>

#include "limn/math/color.h"
#include "limn/math/error.h"

namespace limn {

/// Throws ArgumentError unless `condition` is true. `message` names the argument.
inline void require(bool condition, const std::string& message) {
    if (!condition) throw ArgumentError(message);
}

// Returns true if all three numbers are finite and not negative.
inline bool is_radiance(const Color& c) { return is_finite(c) && c.r >= 0 && c.g >= 0 && c.b >= 0; }
// Returns true if all three numbers are in [0, 1].
inline bool is_reflectance(const Color& c) { return is_radiance(c) && max_component(c) <= 1; }

}  // namespace limn
