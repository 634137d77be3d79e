// Leaks: rays from inside closed meshes aimed at vertices and at points of edges, and rays at the inner edges of strips
// of slivers. All of them hit: a ray from inside a closed surface has to cross it, whatever its vertices were rounded
// to.
#include "accuracy/bodies.h"
#include "accuracy/groups.h"
#include "accuracy/ray_row.h"

namespace limn::accuracy {

namespace {

RayRow closed(const std::shared_ptr<const Subject>& mesh, const std::string& name, double far, bool at_vertices) {
    return {.name = name + named(" at %.0e, ", far) + (at_vertices ? "vertices" : "edges"),
            .x = far,
            .fixed = mesh,
            .ray =
                [far, at_vertices](test::Random& random, const Geometry& g) {
                    // The ball of radius 0.25 around the centre lies inside, with room for what float32 rounds away.
                    const Point3 from = Point3{far, far, far} + 0.25 * random.unit();
                    const Index3& f = g.mesh.triangles[random.index(g.mesh.triangles.size())];
                    const Point3 a = to_point(g.mesh.vertices[f.a]), b = to_point(g.mesh.vertices[f.b]);
                    return ray_through(from, at_vertices ? a : a + random.uniform() * (b - a));
                },
            .must_hit = true};
}

// 64 slivers, each 1 long and 1 / aspect wide, side by side in a plane; `far` along its long side and off the plane,
// where float32 still has room for them.
RayRow strip(double aspect, double far) {
    Geometry g;
    g.in_fours = true;
    const double width = 1 / aspect;
    for (int i = 0; i < 66; ++i) g.mesh.vertices.push_back(test::to_float3({far + i % 2, 0.5 * i * width, far}));
    for (std::uint32_t i = 0; i < 64; ++i)
        g.mesh.triangles.push_back(i % 2 ? Index3{i + 1, i, i + 2} : Index3{i, i + 1, i + 2});
    return {.name = named("strip of slivers of aspect %.0e at %.0e", aspect, far),
            .x = aspect,
            .fixed = std::make_shared<const Subject>(std::move(g)),
            .ray =
                [](test::Random& random, const Geometry& geometry) {
                    const auto& p = geometry.mesh.vertices;
                    const std::size_t i = 16 + random.index(32);  // far from the strip's ends
                    const Point3 a = to_point(p[i]), b = to_point(p[i + 1]);
                    const Point3 target = a + random.uniform(0.1, 0.9) * (b - a);
                    const Vec3 away{random.uniform(-1, 1), random.uniform(-1, 1), random.sign() * random.uniform(1, 2)};
                    return ray_through(target + away, target);
                },
            .must_hit = true,
            .share = 0.1};
}

}  // namespace

Group leak_group(const Effort& effort) {
    std::vector<RayRow> rows;
    for (const bool bumpy : {false, true}) {
        for (const double far : {0.0, 1e3, 1e5}) {
            const auto mesh = std::make_shared<const Subject>(closed_mesh(bumpy, Vec3{far, far, far}));
            for (const bool at_vertices : {true, false})
                rows.push_back(closed(mesh, bumpy ? "bumpy ball" : "icosphere", far, at_vertices));
        }
    }
    for (const double far : {0.0, 1e3})
        for (double aspect = 1e2; aspect < 2e6; aspect *= 10) rows.push_back(strip(aspect, far));
    return measure("leaks", "leaks",
                   {Column::limn, Column::embree, Column::embree_robust, Column::moeller_trumbore, Column::pluecker},
                   rows, effort.leak_rays, effort.threads);
}

}  // namespace limn::accuracy
