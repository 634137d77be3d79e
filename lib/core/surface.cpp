#include "limn/core/surface.h"

#include <algorithm>
#include <cmath>

#include "core/float_environment.h"

namespace limn {

namespace {

// A share of the way that no shape fits into: the error of t that filters reckon with, with room.
constexpr double kShadowEnd = 0x1p-40;

}  // namespace

Point3 offset_origin(const Point3& position, const Vec3& error, const Normal3& normal, const Vec3& direction) {
    const FloatEnvironment environment;
    const double distance = dot(abs(Vec3(normal)), error);
    const Vec3 offset = (dot(normal, direction) < 0 ? -distance : distance) * Vec3(normal);
    Point3 origin = position + offset;
    for (std::size_t a = 0; a < 3; ++a) {  // the sum is rounded, perhaps back towards the surface
        if (offset[a] > 0) origin[a] = std::nextafter(origin[a], kInfinity);
        if (offset[a] < 0) origin[a] = std::nextafter(origin[a], -kInfinity);
    }
    return origin;
}

Ray Surface::spawn_ray(const Vec3& direction, double time) const {
    return {offset_origin(position, position_error, normal, direction), direction, 0, kInfinity, time};
}

Ray Surface::spawn_ray_to(const Point3& target, double time) const {
    const FloatEnvironment environment;
    const Point3 origin = offset_origin(position, position_error, normal, target - position);
    const Vec3 direction = target - origin;
    // A point that was computed lies off its surface by some units in the last place of its largest coordinate; seen
    // at a grazing angle (here: down to 1/8) this is as much more along the ray.
    const double off_surface = gamma(8) * (max_abs(target) + max_abs(origin));
    const double t_max = 1 - 8 * off_surface / max_abs(direction);
    return {origin, direction, 0, std::max(0.0, std::min(t_max, std::nextafter(1.0, 0.0))), time};
}

Ray Surface::spawn_ray_to(const Surface& target, double time) const {
    const FloatEnvironment environment;
    const Point3 from = offset_origin(position, position_error, normal, target.position - position);
    const Point3 to = offset_origin(target.position, target.position_error, target.normal, from - target.position);
    // The direction is rounded, and what lies at the end is told apart from obstacles by the filters' t.
    return {from, to - from, 0, 1 - kShadowEnd, time};
}

}  // namespace limn
