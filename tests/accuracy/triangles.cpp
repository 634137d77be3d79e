// Triangles: random hits of a mesh, rays nearly in the plane, slivers.
#include "accuracy/bodies.h"
#include "accuracy/groups.h"
#include "accuracy/ray_row.h"

namespace limn::accuracy {

namespace {

Point3 corner(const Geometry& g, std::uint32_t i) { return to_point(g.mesh.vertices[i]); }

Geometry one_triangle(const Point3& a, const Point3& b, const Point3& c) {
    Geometry g;
    for (const Point3& p : {a, b, c}) g.mesh.vertices.push_back(test::to_float3(p - Point3{}));
    g.mesh.triangles = {{0, 1, 2}};
    return g;
}

// Of about unit size, anywhere near the origin, turned at random.
Geometry unit_triangle(test::Random& random) {
    const Point3 p = Point3{} + random.in_cube();
    const Vec3 e = random.unit(), f = normalize(cross(e, random.unit()));
    return one_triangle(p, p + e, p + 0.5 * e + f);
}

// As long as 1, as wide as 1 / aspect. Float32 corners leave nothing of a sliver thinner than their own spacing, so it
// lies near the origin of the axis that it is thin along.
Geometry sliver(test::Random& random, double aspect) {
    for (;;) {
        Vec3 along = random.unit(), aside = random.unit();
        const std::size_t thin = random.index(3);
        along[thin] = 0;
        aside = {};
        aside[thin] = 1 / aspect;
        const Point3 p = Point3{} + random.uniform(0, 1 / aspect) * aspect * aside;
        const Geometry g = one_triangle(p, p + along, p + random.uniform(0, 1) * along + aside);
        if (length_squared(along) > 0.01 && !test::exactly_flat(corner(g, 0), corner(g, 1), corner(g, 2))) return g;
    }
}

// From 10 away under `angle` to the plane, to a point of the triangle or beside it.
Ray grazing(test::Random& random, const Geometry& g, double angle) {
    const Point3 a = corner(g, 0);
    const Vec3 e = corner(g, 1) - a, f = corner(g, 2) - a, n = normalize(cross(e, f));
    const Vec3 flat = normalize(cross(n, random.unit()));
    const Point3 target = a + random.uniform(-0.1, 1.1) * e + random.uniform(-0.1, 1.1) * f;
    const Vec3 away = std::cos(angle) * flat + random.sign() * std::sin(angle) * n;
    return ray_through(target + 10 * away, target);
}

// From about 2 away to near the sliver: a third of the rays anywhere about it, the others from 1e-9 to 1e-1 of its
// width beside one of its edges.
Ray at_sliver(test::Random& random, const Geometry& g) {
    const std::uint32_t k = static_cast<std::uint32_t>(random.index(3));
    const Point3 a = corner(g, k);
    const Vec3 e = corner(g, (k + 1) % 3) - a, f = corner(g, (k + 2) % 3) - a;
    const double inward =
        random.chance(1.0 / 3) ? random.uniform(-0.5, 1.5) : random.sign() * random.log_uniform(1e-9, 0.1);
    const Point3 target = a + random.uniform() * e + inward * f;
    return ray_through(target + random.uniform(1, 3) * random.unit(), target);
}

}  // namespace

Group triangle_group(const Effort& effort) {
    std::vector<RayRow> rows;
    for (const double far : {0.0, 1e3, 1e5}) {
        const auto mesh = std::make_shared<const Subject>(closed_mesh(false, Vec3{far, far, far}));
        rows.push_back({.name = named("random hits of an icosphere at %.0e", far),
                        .x = far,
                        .fixed = mesh,
                        .ray =
                            [far](test::Random& random, const Geometry&) {
                                const Point3 center{far, far, far};
                                return ray_through(center + 3 * random.unit(), center + random.in_cube());
                            },
                        .without_hit = true});
    }
    for (const double angle : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
        rows.push_back({.name = named("grazing at %.0e rad, unit triangle, eye 10 away", angle),
                        .x = angle,
                        .geometry = unit_triangle,
                        .ray = [angle](test::Random& random, const Geometry& g) { return grazing(random, g, angle); }});
    for (double aspect = 1e2; aspect < 2e7; aspect *= 10)
        rows.push_back({.name = named("sliver of aspect %.0e", aspect),
                        .x = aspect,
                        .geometry = [aspect](test::Random& random) { return sliver(random, aspect); },
                        .ray = at_sliver,
                        .chunk = 512});
    return measure("triangles", "decisions",
                   {Column::limn, Column::limn_hit, Column::embree, Column::embree_robust, Column::moeller_trumbore,
                    Column::pluecker},
                   rows, effort.rays, effort.threads);
}

}  // namespace limn::accuracy
