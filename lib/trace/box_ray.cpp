#include "trace/box_ray.h"

#include <algorithm>

namespace limn::trace {

void BoxRay::set_planes(float wider, const float* from) {
    octant = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const float size = std::abs(direction[a]);
        inverse[a] = 1 / std::copysign(size > kLeast ? size : kLeast, direction[a]);
        const float shift = -from[a] * inverse[a], widening = wider * std::abs(inverse[a]);
        near_shift[a] = shift - widening;
        far_shift[a] = shift + widening;
        octant |= std::signbit(direction[a]) ? 1u << a : 0u;
    }
}

void BoxRay::adapt(const RayFrame& frame, const flat::Blas& blas) {
    const Ray& ray = frame.ray;
    is_taken_as_it_is = false;
    t_error = origin_error = direction_error = 0;
    scale = 1;
    extent = static_cast<float>(blas.extent);
    const auto size = [](const Vec3& v) { return largest_magnitude(v.x, v.y, v.z); };
    const double unit = std::ldexp(1.0, std::min(-std::ilogb(size(ray.direction)), 1000));
    const Vec3 along = unit * ray.direction;  // its largest coordinate in [1, 2)
    const double along_error = unit * frame.direction_error;
    t_scale = blas.scale / unit;
    t_start = 0;

    Point3 at = Point3{} + blas.scale * (ray.origin - Point3{}), origin = ray.origin;
    const double box_extent = blas.scale * blas.extent;
    double box_reach = size(at - Point3{}) + box_extent;
    double at_error = blas.scale * frame.origin_error, t_start_error = 0;
    if (box_reach > static_cast<double>(kFar) * box_extent) {
        // From where the ray comes closest to the middle.
        t_start = dot(Point3{} - at, along) / dot(along, along);
        at = at + t_start * along;
        at_error += 0x1p-48 * box_reach + along_error * std::abs(t_start);
        t_start_error = 0x1p-30 * box_reach;
        box_reach = size(at - Point3{}) + box_extent;
        origin = Point3{} + (1 / blas.scale) * (at - Point3{});
    }
    const double wider = static_cast<double>(kWider) * box_reach + 2 * (at_error + along_error * box_reach);
    if (wider + t_start_error < 0x1p50 && along_error < 0x1p-3 && size(along) >= 1 && t_scale > 0x1p-1000 &&
        t_scale < kInfinity) {
        for (std::size_t a = 0; a < 3; ++a) {
            high[a] = static_cast<float>(origin[a]);
            low[a] = static_cast<float>(origin[a] - static_cast<double>(high[a]));
            direction[a] = static_cast<float>(along[a]);
        }
        reach = largest(high) + extent;
        scale = static_cast<float>(smaller(blas.scale, 0x1p100));
        origin_error = static_cast<float>(at_error / blas.scale);
        direction_error = static_cast<float>(along_error);
        t_error = static_cast<float>(t_start_error);
        const float box_from[3] = {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
        set_planes(static_cast<float>(wider), box_from);
        t_min = lower(ray.t_min);
        return;
    }
    // Nothing is known of where the ray goes: every box is met, but an absent one, whose sides are infinite; what the
    // leaves read has no bound on its error.
    octant = 0;
    t_min = -std::numeric_limits<float>::infinity();
    t_start = -kInfinity;
    for (std::size_t a = 0; a < 3; ++a) {
        direction[a] = inverse[a] = 1;
        high[a] = low[a] = 0;
        near_shift[a] = -std::numeric_limits<float>::max();
        far_shift[a] = std::numeric_limits<float>::max();
    }
    reach = origin_error = std::numeric_limits<float>::infinity();
}

}  // namespace limn::trace
