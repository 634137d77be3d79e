/// \file
/// Numeric constants, and a bound on accumulated rounding errors.
#pragma once

#include <limits>

#ifdef __FAST_MATH__
#error "limn decides hits by exact comparisons: build without -ffast-math"
#endif

namespace limn {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();  ///< infinity; the t of a miss
inline constexpr double kPi = 3.14159265358979323846;                         ///< the double nearest to pi

/// The largest relative error of one rounded operation on doubles, 2^-53.
inline constexpr double kRoundoff = std::numeric_limits<double>::epsilon() / 2;

/// Returns a bound on the relative error that n rounded operations accumulate (Higham, Accuracy and Stability of
/// Numerical Algorithms, 2nd ed., 2002, Lemma 3.1).
/// \pre n >= 0
constexpr double gamma(int n) { return n * kRoundoff / (1 - n * kRoundoff); }

/// Converts degrees to radians.
constexpr double radians(double degrees) { return degrees * (kPi / 180); }

}  // namespace limn
