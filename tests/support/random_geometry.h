// Random points, directions and rays for tests, and the rays that break intersectors: along edges, through vertices,
// tangent, parallel to the axes with either zero, of huge and tiny directions.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "limn/math/box.h"
#include "limn/math/ray.h"

namespace limn::test {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    std::size_t index(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }
    bool chance(double probability) { return uniform() < probability; }
    double sign() { return chance(0.5) ? 1 : -1; }

    Vec3 in_cube(double half_side = 1) {
        const double x = uniform(-half_side, half_side), y = uniform(-half_side, half_side);
        return {x, y, uniform(-half_side, half_side)};
    }
    Vec3 unit() {
        for (;;) {
            const Vec3 v = in_cube();
            if (length_squared(v) <= 1 && length_squared(v) > 1e-4) return normalize(v);
        }
    }
    Point3 in_box(const Box& b) {
        const double x = uniform(b.lower.x, b.upper.x), y = uniform(b.lower.y, b.upper.y);
        return {x, y, uniform(b.lower.z, b.upper.z)};
    }

private:
    std::mt19937_64 engine_;
};

/// What rays are aimed at: the region around a scene, and its awkward points (vertices, poles, centres, edges).
struct Targets {
    Box region;
    std::vector<Point3> points;
};

/// A ray of one of ten kinds, half of them degenerate on purpose.
inline Ray random_ray(Random& random, const Targets& targets) {
    const Vec3 size = targets.region.diagonal();
    const double reach = std::max({size.x, size.y, size.z, 1e-6});
    const Box around{targets.region.lower - Vec3{reach, reach, reach},
                     targets.region.upper + Vec3{reach, reach, reach}};
    const auto target = [&] { return targets.points[random.index(targets.points.size())]; };
    const auto zero = [&] { return std::copysign(0.0, random.sign()); };

    Ray ray{.origin = random.in_box(around), .direction = random.unit()};
    switch (random.index(10)) {
        case 0: break;
        case 1: ray.direction = target() - ray.origin; break;
        case 2: {  // parallel to an axis, through a target
            const std::size_t axis = random.index(3);
            const Point3 p = target();
            for (std::size_t a = 0; a < 3; ++a) {
                if (a == axis) {
                    ray.direction[a] = p[a] < ray.origin[a] ? -1 : 1;
                } else {
                    ray.direction[a] = zero();
                    ray.origin[a] = p[a];
                }
            }
            break;
        }
        case 3: {  // in a plane of the axes, through a target
            const std::size_t axis = random.index(3);
            const Point3 p = target();
            ray.origin[axis] = p[axis];
            ray.direction = p - ray.origin;
            ray.direction[axis] = zero();
            break;
        }
        case 4: ray.origin = target(); break;
        case 5: {  // from one target to another: along edges and diagonals
            const Point3 from = target(), to = target();
            ray.direction = to - from;
            ray.origin = random.chance(0.5) ? from : from - ray.direction;
            break;
        }
        case 6: {
            const double scale = std::ldexp(1.0, static_cast<int>(random.index(184)) - 100);  // 1e-30 .. 1e25
            ray.direction = scale * (target() - ray.origin);
            break;
        }
        case 7: {  // from far away, close to a target
            const Point3 near = target() + random.uniform(0, 1e-3) * reach * random.unit();
            ray.origin = near + reach * random.log_uniform(10, 1e6) * random.unit();
            ray.direction = near - ray.origin;
            break;
        }
        case 8: {  // half an inch beside a target
            const Point3 p = target() + random.log_uniform(1e-9, 1e-1) * reach * random.unit();
            ray.direction = random.uniform(0.5, 2) * (p - ray.origin);
            break;
        }
        default: ray.direction = random.in_box(targets.region) - ray.origin; break;
    }
    if (ray.direction == Vec3{}) ray.direction = {0, 0, 1};

    const double to_region =
        reach / std::max({std::abs(ray.direction.x), std::abs(ray.direction.y), std::abs(ray.direction.z)});
    switch (random.index(8)) {
        case 0: ray.t_max = random.uniform(0, 3) * to_region; break;
        case 1: ray.t_min = random.uniform(0, 2) * to_region; break;
        case 2: ray.t_min = -random.uniform(0, 2) * to_region; break;
        case 3:
            if (random.chance(0.2)) ray.t_min = -kInfinity;
            break;
        default: break;
    }
    switch (random.index(6)) {
        case 0: ray.time = 1; break;
        case 1: ray.time = random.chance(0.5) ? -0.5 : 1.5; break;
        case 2: break;
        default: ray.time = random.uniform(); break;
    }
    return ray;
}

/// Every special value in every field that makes a ray unusable.
inline std::vector<Ray> unusable_rays() {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Ray good{.origin = {0, 0, 5}, .direction = {0, 0, -1}};
    std::vector<Ray> rays;
    for (std::size_t a = 0; a < 3; ++a) {
        for (const double bad : {nan, kInfinity, -kInfinity}) {
            Ray origin = good, direction = good;
            origin.origin[a] = bad;
            direction.direction[a] = bad;
            rays.push_back(origin);
            rays.push_back(direction);
        }
    }
    for (const Vec3 zero : {Vec3{0, 0, 0}, Vec3{-0.0, 0, -0.0}}) {
        Ray ray = good;
        ray.direction = zero;
        rays.push_back(ray);
    }
    const auto with_range = [&](double t_min, double t_max) {
        Ray ray = good;
        ray.t_min = t_min, ray.t_max = t_max;
        rays.push_back(ray);
    };
    with_range(nan, kInfinity);
    with_range(0, nan);
    with_range(kInfinity, kInfinity);
    with_range(7, 6);
    for (const double bad : {nan, kInfinity, -kInfinity}) {
        Ray ray = good;
        ray.time = bad;
        rays.push_back(ray);
    }
    return rays;
}

}  // namespace limn::test
