// Checks of arguments that several rooms share.
#pragma once

#include <string>

#include "limn/core/color.h"
#include "limn/core/error.h"

namespace limn {

/// \throws ArgumentError with `message`, which names the argument, unless the condition is met
inline void require(bool condition, const std::string& message) {
    if (!condition) throw ArgumentError(message);
}

inline bool is_radiance(const Color& c) { return is_finite(c) && c.r >= 0 && c.g >= 0 && c.b >= 0; }
inline bool is_reflectance(const Color& c) { return is_radiance(c) && max_component(c) <= 1; }

}  // namespace limn
