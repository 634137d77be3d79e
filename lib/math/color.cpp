#include "limn/math/color.h"

#include "math/elementary.h"

namespace limn {

// Both curves are defined in IEC 61966-2-1:1999, section 5.2. They are extended to negative numbers as odd functions.
double srgb_encode(double linear) {
    const double x = std::abs(linear);
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * power(x, 1 / 2.4) - 0.055;
    return std::copysign(encoded, linear);
}

double srgb_decode(double encoded) {
    const double x = std::abs(encoded);
    const double linear = x <= 0.04045 ? x / 12.92 : power((x + 0.055) / 1.055, 2.4);
    return std::copysign(linear, encoded);
}

}  // namespace limn
