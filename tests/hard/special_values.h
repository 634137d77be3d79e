// The doubles that break arithmetic, for every field of everything.
#pragma once

#include <array>
#include <limits>

#include "limn/math/math.h"

namespace limn::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Finite ones up to 3e38 in size, where answers are exact.
inline constexpr std::array kFiniteValues{
    0.0,   -0.0,   5e-324,    -5e-324, 1e-310, -1e-310, 0x1p-1022, -0x1p-1022, 1e-200, -1e-200,
    1e-45, -1e-38, 0x1p-126,  1e-30,   -1e-16, 0x1p-53, 0.1,       -0.1,       0.5,    1.0,
    -1.0,  2.0,    1 + 1e-15, 1e7,     -1e15,  1e25,    -1e30,     3e38,       -3e38,  0x1.fffffep127};

/// Finite ones beyond: limn may not be able to say where the hit is, but does not falter.
inline constexpr std::array kHugeValues{
    1e80, -1e154, 1.4e154, -1e200, 1e300, 0x1.fffffffffffffp1023, -0x1.fffffffffffffp1023};

inline constexpr std::array kUnusableValues{kNaN, -kNaN, kInfinity, -kInfinity};

}  // namespace limn::test
