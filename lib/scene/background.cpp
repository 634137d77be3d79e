#include "limn/scene/background.h"

namespace limn {

Color Background::radiance(const Vec3& direction) const {
    if (bottom == top) return bottom;
    const double a = (normalize(direction).y + 1) / 2;
    return (1 - a) * bottom + a * top;
}

}  // namespace limn
