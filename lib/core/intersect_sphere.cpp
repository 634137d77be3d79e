#include "core/intersect_sphere.h"

#include <algorithm>

namespace limn {

// Lengths and the direction are scaled by powers of two, which is exact.
SphereRoots sphere_roots_scaled(const Vec3& from_center, double radius, const Vec3& direction) {
    const auto exponent = [](double x) {
        int e = 0;
        std::frexp(x, &e);
        return e;
    };
    const auto scaled = [](const Vec3& v, int e) {
        return Vec3{std::ldexp(v.x, -e), std::ldexp(v.y, -e), std::ldexp(v.z, -e)};
    };
    const int lengths = exponent(std::max(radius, max_abs(from_center))), way = exponent(max_abs(direction));
    SphereRoots roots =
        sphere_roots_in_range(scaled(from_center, lengths), std::ldexp(radius, -lengths), scaled(direction, way));
    roots.near = std::ldexp(roots.near, lengths - way);
    roots.far = std::ldexp(roots.far, lengths - way);
    return roots;
}

}  // namespace limn
