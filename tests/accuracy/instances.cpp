// A unit sphere seen through a matrix: turned, scaled, far away.
#include "accuracy/bodies.h"
#include "accuracy/groups.h"
#include "accuracy/ray_row.h"

namespace limn::accuracy {

Group instance_group(const Effort& effort) {
    std::vector<RayRow> rows;
    for (const double far : {0.0, 1e3, 1e5}) {
        for (const double scale : {1e-3, 1.0, 1e3}) {
            const auto geometry = [far, scale](test::Random& random) {
                Geometry g;
                g.radius = 1;
                Transform m = Transform::translate({far, -far, far}) *
                              Transform::rotate(random.unit(), random.uniform(0, 360)) *
                              Transform::scale(scale, scale, scale);
                for (auto& row : m.rows)
                    for (double& x : row) x = to_float(x);
                g.world_from_object = m;
                return g;
            };
            const auto ray = [scale](test::Random& random, const Geometry& g) {
                const Point3 center = Point3{} + g.world_from_object->translation();
                const Vec3 away = random.unit();
                const double off = 1.5 * scale * std::sqrt(random.uniform());
                return ray_through(center + 10 * scale * away, center + off * across(random, away));
            };
            rows.push_back({.name = named("unit sphere scaled by %.0e at %.0e", scale, far),
                            .x = far,
                            .geometry = geometry,
                            .ray = ray});
        }
    }
    return measure("instances", "decisions",
                   {Column::limn, Column::limn_hit, Column::embree, Column::embree_robust, Column::book_sphere_float},
                   rows, effort.rays, effort.threads);
}

}  // namespace limn::accuracy
