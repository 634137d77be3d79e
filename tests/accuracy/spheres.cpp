// Spheres small and far away, large and near, and rays of extreme length.
#include "accuracy/bodies.h"
#include "accuracy/groups.h"
#include "accuracy/ray_row.h"

namespace limn::accuracy {

namespace {

Geometry ball(const Point3& center, double radius) {
    Geometry g;
    g.center = to_float(center);
    g.radius = to_float(radius);
    return g;
}

// Seen from around the origin, aimed at a disc half as large again as the sphere.
Ray beside(test::Random& random, const Geometry& g) {
    const Point3 from = Point3{} + random.in_cube();
    const double off = 1.5 * g.radius * std::sqrt(random.uniform());
    return ray_through(from, g.center + off * across(random, g.center - from));
}

// An eye 1 above the ground.
Ray downward(test::Random& random, const Geometry&) {
    Ray ray;
    ray.origin = {0, 1, 0};
    const double angle = 2 * kPi * random.uniform(), height = random.uniform(-1, 0);
    const double flat = std::sqrt(1 - height * height);
    ray.direction = to_float(Vec3{flat * std::cos(angle), height, flat * std::sin(angle)});
    return ray;
}

// From the same eye to within 1 % of the angle under which the horizon lies.
Ray to_horizon(test::Random& random, const Geometry& g) {
    Ray ray;
    ray.origin = {0, 1, 0};
    const double dip = std::acos(g.radius / (g.radius + 1)) * random.uniform(0.99, 1.01);
    const double angle = 2 * kPi * random.uniform();
    ray.direction = to_float(Vec3{std::cos(dip) * std::cos(angle), -std::sin(dip), std::cos(dip) * std::sin(angle)});
    return ray;
}

}  // namespace

Group sphere_group(const Effort& effort) {
    std::vector<RayRow> rows;
    for (double ratio = 1e2; ratio < 2e7; ratio *= 10) {
        rows.push_back({.name = named("small sphere, distance / radius = %.0e", ratio),
                        .x = ratio,
                        .geometry = [ratio](test::Random& random) { return ball(Point3{} + ratio * random.unit(), 1); },
                        .ray = beside});
    }
    for (double r = 1e3; r < 2e7; r *= 10)
        rows.push_back({.name = named("ground sphere from 1 above, radius %.0e", r),
                        .x = r,
                        .geometry =
                            [r](test::Random&) {
                                return ball({0, -r, 0}, r);
                            },
                        .ray = downward});
    for (double r = 1e3; r < 2e7; r *= 10)
        rows.push_back({.name = named("its horizon ±1 %% of the dip, radius %.0e", r),
                        .x = r,
                        .geometry =
                            [r](test::Random&) {
                                return ball({0, -r, 0}, r);
                            },
                        .ray = to_horizon});
    for (const double far : {1e3, 1e6}) {
        rows.push_back({.name = named("unit sphere at %.0e, eye 10 away", far),
                        .x = far,
                        .geometry = [far](test::Random& random) { return ball(Point3{} + far * random.unit(), 1); },
                        .ray =
                            [](test::Random& random, const Geometry& g) {
                                const Vec3 to_eye = random.unit();
                                const double off = 1.5 * std::sqrt(random.uniform());
                                return ray_through(g.center + 10 * to_eye, g.center + off * across(random, to_eye));
                            }});
    }
    for (const double size : {1e-30, 1e-22, 1e19, 1e25}) {
        rows.push_back({.name = named("unit sphere, eye 10 away, direction of length %.0e", size),
                        .x = size,
                        .geometry =
                            [](test::Random&) {
                                return ball({0, 0, 0}, 1);
                            },
                        .ray =
                            [size](test::Random& random, const Geometry& g) {
                                const Vec3 to_eye = random.unit();
                                const double off = 1.5 * std::sqrt(random.uniform());
                                Ray ray = ray_through(g.center + 10 * to_eye, g.center + off * across(random, to_eye));
                                ray.direction = to_float(size * normalize(ray.direction));
                                return ray;
                            },
                        .lethal = size > 1e18});
    }
    return measure("spheres", "decisions",
                   {Column::limn, Column::limn_hit, Column::embree, Column::embree_robust, Column::book_sphere_float,
                    Column::book_sphere_double},
                   rows, effort.rays, effort.threads);
}

}  // namespace limn::accuracy
