// Shapes and rays that several groups of hard cases use.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "support/random_geometry.h"
#include "support/scene_zoo.h"

namespace limn::test {

inline Ray towards(const Point3& origin, const Vec3& direction) { return {.origin = origin, .direction = direction}; }

/// The nearest numbers in float32.
///@{
inline Vec3 to_float(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline Point3 to_float(const Point3& p) { return Point3{} + to_float(p - Point3{}); }
///@}

/// Times 2^power, rounded where it becomes subnormal.
///@{
inline Vec3 scaled(const Vec3& v, int power) {
    return {std::ldexp(v.x, power), std::ldexp(v.y, power), std::ldexp(v.z, power)};
}
inline Point3 scaled(const Point3& p, int power) { return Point3{} + scaled(p - Point3{}, power); }
///@}
/// Lengths times 2^size, the direction times 2^speed.
inline Ray scaled(const Ray& ray, int size, int speed) {
    Ray result = ray;
    result.origin = scaled(ray.origin, size);
    result.direction = scaled(ray.direction, speed);
    return result;
}

/// Shapes of all kinds and sizes around a point.
inline std::vector<Object> company_near(Random& random, const Point3& p, double size) {
    std::vector<Object> company;
    for (int i = 0; i < 3; ++i) {
        const Point3 q = p + random.in_cube(4 * size), r = p + random.in_cube(4 * size);
        company.push_back(ball(q, random.log_uniform(1e-3, 2) * size));
        company.push_back(std::make_shared<Quad>(q, random.in_cube(size), random.in_cube(size), nullptr));
        company.push_back(std::make_shared<Triangle>(q, q + random.in_cube(size), r, nullptr));
    }
    return company;
}

}  // namespace limn::test
