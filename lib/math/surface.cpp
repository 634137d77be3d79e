#include "limn/math/surface.h"

#include <algorithm>
#include <cmath>

#include "math/float_environment.h"
#include "math/spawn-inl.h"
#include "math/spawn.h"

HWY_BEFORE_NAMESPACE();
namespace limn {

namespace inl = HWY_NAMESPACE;

Point3 offset_along(const Point3& position, const Vec3& error, const Normal3& normal, const Vec3& direction) {
    const inl::Vector<double> origin =
        inl::offset_along(inl::broadcast<double>(position), inl::broadcast<double>(error),
                          inl::broadcast<double>(normal), inl::broadcast<double>(direction));
    return {origin.x, origin.y, origin.z};
}

Point3 offset_origin(const Point3& position, const Vec3& error, const Normal3& normal, const Vec3& direction) {
    const FloatEnvironment environment;
    return offset_along(position, error, normal, direction);
}

Ray Surface::spawn_ray(const Vec3& direction, double time) const {
    return {offset_origin(position, position_error, normal, direction), direction, 0, kInfinity, time};
}

Ray Surface::spawn_ray_to(const Point3& target, double time) const {
    const FloatEnvironment environment;
    const Point3 origin = offset_along(position, position_error, normal, target - position);
    const Vec3 direction = target - origin;
    // A computed target is off its surface by a few units in the last place of its largest coordinate. Along a ray this
    // distance is divided by the cosine at the surface; the factor 8 covers cosines down to 1/8.
    const double off_surface = gamma(8) * (max_abs(target) + max_abs(origin));
    const double t_max = 1 - 8 * off_surface / max_abs(direction);
    return {origin, direction, 0, std::max(0.0, std::min(t_max, std::nextafter(1.0, 0.0))), time};
}

Ray Surface::spawn_ray_to(const Surface& target, double time) const {
    const FloatEnvironment environment;
    const Point3 from = offset_along(position, position_error, normal, target.position - position);
    const Point3 to = offset_along(target.position, target.position_error, target.normal, from - target.position);
    // The direction is rounded, so the ray hits the target's own surface near t = 1, not exactly there. t_max excludes
    // it.
    return {from, to - from, 0, 1 - kShadowEnd, time};
}

}  // namespace limn
HWY_AFTER_NAMESPACE();
