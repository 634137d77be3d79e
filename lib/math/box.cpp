#include "limn/math/box.h"

#include <cmath>

namespace limn {

Box grow(const Box& b, const Vec3& amount) {
    Box grown;
    for (std::size_t a = 0; a < 3; ++a) {
        grown.lower[a] = std::nextafter(b.lower[a] - amount[a], -kInfinity);
        grown.upper[a] = std::nextafter(b.upper[a] + amount[a], kInfinity);
    }
    return b.is_empty() ? b : grown;
}

}  // namespace limn
