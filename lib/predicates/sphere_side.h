// Which roots of a sphere a ray has no use for, by signs that need no square root: of rays that leave a sphere or end
// at one, which the float forms leave undecided.
#pragma once

#include <cmath>

#include "limn/core/math.h"
#include "limn/core/ray.h"
#include "limn/core/vec.h"
#include "predicates/filter.h"

namespace limn {

inline double sum_of_magnitudes(const Vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// Of a point p, seen from the centre, and a direction d: p.p - r^2 is off by 8 u (L^2 + r^2), L the sum of p's
// magnitudes, p.d by 4 u L times that of d, and what underflows; where p itself is off by `p_error`, by 2 L, and by d's
// magnitudes, times that more.
struct SphereSide {
    int power, along;  // signs of p.p - r^2 and of p.d; 0 where in doubt

    SphereSide(const Vec3& p, const Vec3& d, double radius, double p_error) {
        const auto sign = [](double x, double error) { return x > error ? 1 : x < -error ? -1 : 0; };
        const double reach = sum_of_magnitudes(p), r2 = radius * radius, length = sum_of_magnitudes(d);
        power = sign(dot(p, p) - r2,
                     9 * kRoundoff * (reach * reach + r2) + p_error * (2.01 * reach + 4 * p_error) + 0x1p-900);
        along = sign(dot(p, d), length * (5 * kRoundoff * reach + 1.01 * p_error) + 0x1p-900);
    }
};

// Inside: the second root is ahead of the origin, the first is not.
enum class Side { unknown, missed, inside };

// \pre t_min is not negative. Missed: the ray starts outside and goes away, or, if it ends just before t = 1, ends
// outside on its way there. What that meets at t >= 1 no filter takes for less than t_max: see ListPacket.
inline Side side_of(const Point3& center, double radius, const Ray& ray) {
    const SphereSide start(ray.origin - center, ray.direction, radius, 0);
    if (start.power < 0) return Side::inside;
    if (start.power > 0 && start.along > 0) return Side::missed;
    if (!(ray.t_max < 1)) return Side::unknown;
    const Point3 to = ray.origin + ray.direction;
    const SphereSide end(to - center, ray.direction, radius, kRoundoff * (1 + 0x1p-20) * max_abs(to));
    return end.power > 0 && end.along < 0 ? Side::missed : Side::unknown;
}

}  // namespace limn
