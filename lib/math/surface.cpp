#include "limn/math/surface.h"

#include <algorithm>
#include <cmath>

#include "math/float_environment.h"
#include "math/spawn.h"

namespace limn {

Point3 offset_origin(const Point3& position, const Vec3& error, const Normal3& normal, const Vec3& direction) {
    const FloatEnvironment environment;
    return offset_along(position, error, normal, direction);
}

Ray Surface::spawn_ray(const Vec3& direction, double time) const {
    const FloatEnvironment environment;
    return leave(*this, direction, time);
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
    return leave_for(*this, target, time);
}

}  // namespace limn
