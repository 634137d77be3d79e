#include "limn/math/vec.h"

namespace limn {

Vec3 normalize_extreme(double x, double y, double z) {
    const Vec3 scaled = scale_to_one({x, y, z});
    return scaled / std::sqrt(dot(scaled, scaled));
}

}  // namespace limn
