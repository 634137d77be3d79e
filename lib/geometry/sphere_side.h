// Tests which roots of a sphere are outside a ray, by signs that need no square root. They are for rays that start or
// end on a sphere, which the float tests cannot decide.
#pragma once

#include <cmath>

#include "geometry/filter.h"
#include "limn/math/math.h"
#include "limn/math/ray.h"
#include "limn/math/vec.h"

namespace limn {

// Returns the sum of the magnitudes of the coordinates.
inline double sum_of_magnitudes(const Vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// The position of a point p, relative to the centre of a sphere, and of a direction d.
//
// Let L and M be the sums of the magnitudes of the coordinates of p and d, r the radius and u = kRoundoff. Then p.p -
// r^2 is off by at most 8 u (L^2 + r^2), and p.d by at most 4 u L M, including the rounding of p. If each coordinate of
// p is off by `p_error` besides, this adds p_error (2 L + 3 p_error) and p_error M. The bounds are a little larger, for
// their own rounding and for products that underflow.
struct SphereSide {
    int power;  // sign of p.p - r^2, negative inside the sphere; 0 if uncertain
    int along;  // sign of p.d, positive if d points away from the centre; 0 if uncertain

    SphereSide(const Vec3& p, const Vec3& d, double radius, double p_error) {
        const auto sign = [](double x, double error) { return x > error ? 1 : x < -error ? -1 : 0; };
        const double reach = sum_of_magnitudes(p), r2 = radius * radius, length = sum_of_magnitudes(d);
        power = sign(dot(p, p) - r2,
                     9 * kRoundoff * (reach * reach + r2) + p_error * (2.01 * reach + 4 * p_error) + 0x1p-900);
        along = sign(dot(p, d), length * (5 * kRoundoff * reach + 1.01 * p_error) + 0x1p-900);
    }
};

// The result of side_of():
//   - missed: the ray surely misses the sphere;
//   - inside: the ray surely starts inside, so only the second root is after its origin.
enum class Side { unknown, missed, inside };

// Decides on which side of a sphere a ray starts and ends. \pre t_min is not negative
//
// The ray misses if it starts outside and goes away from the centre. A ray with t_max < 1 also misses if the point at t
// = 1 is outside and the ray goes towards the centre there: then both roots are at t >= 1. No filter would report them
// with a t below t_max: the error of that t would exceed 1 - t_max, and judge() would leave the decision to the exact
// test.
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
