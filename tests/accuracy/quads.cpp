// Parallelograms, alone and as the six sides of a box, seen from inside.
#include "accuracy/bodies.h"
#include "accuracy/groups.h"
#include "accuracy/ray_row.h"

namespace limn::accuracy {

namespace {

// A multiple of 2^-10: sums of a few of them up to 2^13 are float32 numbers too.
double on_grid(double x) { return std::ldexp(std::round(std::ldexp(x, 10)), -10); }
Vec3 on_grid(const Vec3& v) { return {on_grid(v.x), on_grid(v.y), on_grid(v.z)}; }

// The six sides of a parallelepiped. Its corners are float32 numbers, the same for every side that meets there, so that
// it is closed.
Geometry box(const Point3& corner, const Vec3& x, const Vec3& y, const Vec3& z) {
    Geometry g;
    g.quads = {{corner, x, y},     {corner, y, z},     {corner, z, x},
               {corner + z, x, y}, {corner + x, y, z}, {corner + y, z, x}};
    return g;
}

Geometry upright_box(test::Random& random, double far) {
    const Point3 p = Point3{} + on_grid(Vec3{far, far, far} + random.in_cube());
    return box(p, {on_grid(random.uniform(1, 2)), 0, 0}, {0, on_grid(random.uniform(1, 2)), 0},
               {0, 0, on_grid(random.uniform(1, 2))});
}

// Turned by 30 degrees about a random axis, its edges rounded to the grid.
Geometry turned_box(test::Random& random, double far) {
    const Transform turn = Transform::rotate(random.unit(), 30);
    const auto edge = [&](const Vec3& v) { return on_grid(transform_vector(turn, v)); };
    return box(Point3{} + on_grid(Vec3{far, far, far} + random.in_cube()), edge({1.5, 0, 0}), edge({0, 1.5, 0}),
               edge({0, 0, 1.5}));
}

// From the middle half of the box to a corner, or to a point of an edge.
Ray from_inside(test::Random& random, const Geometry& g, bool at_corners, double size) {
    const Parallelogram& side = g.quads[random.index(6)];
    const Vec3 x = g.quads[0].edge_u, y = g.quads[0].edge_v, z = g.quads[1].edge_v;
    const Point3 from = g.quads[0].corner + random.uniform(0.25, 0.75) * x + random.uniform(0.25, 0.75) * y +
                        random.uniform(0.25, 0.75) * z;
    Point3 target = side.corner + static_cast<double>(random.index(2)) * side.edge_u;
    if (!at_corners) target = target + random.uniform() * side.edge_v;
    Ray ray = ray_through(from, target);
    if (size != 1) ray.direction = to_float(size * ray.direction);
    return ray;
}

// A parallelogram with 0.1 degrees between its edges, one 100 times as long as the other.
Geometry flat_parallelogram(test::Random& random) {
    for (;;) {
        const Vec3 u = random.unit(), aside = across(random, u);
        const Vec3 v = 0.01 * (std::cos(radians(0.1)) * u + std::sin(radians(0.1)) * aside);
        // Float32 numbers with room for their sums.
        const auto coarse = [](const Vec3& e) {
            return Vec3{std::ldexp(std::round(std::ldexp(e.x, 22)), -22),
                        std::ldexp(std::round(std::ldexp(e.y, 22)), -22),
                        std::ldexp(std::round(std::ldexp(e.z, 22)), -22)};
        };
        const Parallelogram q{{0, 0, 0}, coarse(u), coarse(v)};
        Geometry g;
        g.quads = {q};
        if (!(cross(q.edge_u, q.edge_v) == Vec3{})) return g;
    }
}

Ray at_parallelogram(test::Random& random, const Geometry& g) {
    const Parallelogram& q = g.quads[0];
    const double u = random.chance(0.5) ? random.uniform(-0.1, 1.1) : static_cast<double>(random.index(2));
    const Point3 target = q.corner + u * q.edge_u + random.uniform(-0.1, 1.1) * q.edge_v;
    return ray_through(target + random.uniform(1, 3) * random.unit(), target);
}

const std::vector<Column> kColumns{Column::limn, Column::limn_hit, Column::embree, Column::embree_robust,
                                   Column::book_quad};

}  // namespace

Group quad_group(const Effort& effort) {
    std::vector<RayRow> rows;
    for (const double angle : {1e-2, 1e-4, 1e-6})
        rows.push_back({.name = named("unit square, grazing at %.0e rad, eye 10 away", angle),
                        .x = angle,
                        .geometry =
                            [](test::Random& random) {
                                Geometry g;
                                const Vec3 u = on_grid(random.unit()), v = on_grid(across(random, u));
                                g.quads = {{Point3{} + on_grid(random.in_cube()), u, v}};
                                return g;
                            },
                        .ray =
                            [angle](test::Random& random, const Geometry& g) {
                                const Parallelogram& q = g.quads[0];
                                const Vec3 n = normalize(cross(q.edge_u, q.edge_v));
                                const Point3 target = q.corner + random.uniform(-0.1, 1.1) * q.edge_u +
                                                      random.uniform(-0.1, 1.1) * q.edge_v;
                                const Vec3 away = std::cos(angle) * across(random, n) + std::sin(angle) * n;
                                return ray_through(target + 10 * away, target);
                            }});
    rows.push_back({.name = "parallelogram, 0.1 degrees between edges of 1 and 0.01",
                    .geometry = flat_parallelogram,
                    .ray = at_parallelogram});
    for (const double size : {1e-30, 1e-9, 1e15})
        rows.push_back({.name = named("square (-1, 1)², direction of length %.0e", size),
                        .x = size,
                        .geometry =
                            [](test::Random&) {
                                Geometry g;
                                g.quads = {{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}};
                                return g;
                            },
                        .ray =
                            [size](test::Random& random, const Geometry&) {
                                Ray ray = ray_through({random.uniform(-1.1, 1.1), random.uniform(-1.1, 1.1), 1},
                                                      {random.uniform(-1.1, 1.1), random.uniform(-1.1, 1.1), 0});
                                ray.direction = to_float(size * ray.direction);
                                return ray;
                            }});
    return measure("quads", "decisions", kColumns, rows, effort.rays, effort.threads);
}

Group quad_leak_group(const Effort& effort) {
    std::vector<RayRow> rows;
    for (const bool turned : {false, true})
        for (const double far : {0.0, 1e3})
            for (const bool at_corners : {true, false})
                rows.push_back(
                    {.name = std::string(turned ? "turned box" : "upright box") + named(" at %.0e, ", far) +
                             (at_corners ? "corners" : "edges"),
                     .x = far,
                     .geometry =
                         [turned, far](test::Random& random) {
                             return turned ? turned_box(random, far) : upright_box(random, far);
                         },
                     .ray = [at_corners](test::Random& random,
                                         const Geometry& g) { return from_inside(random, g, at_corners, 1); },
                     .must_hit = true});
    rows.push_back({.name = "upright box at 0e+00, edges, direction of length 1e-09",
                    .geometry = [](test::Random& random) { return upright_box(random, 0); },
                    .ray = [](test::Random& random, const Geometry& g) { return from_inside(random, g, false, 1e-9); },
                    .must_hit = true});
    return measure("quad leaks", "leaks", kColumns, rows, effort.rays, effort.threads);
}

}  // namespace limn::accuracy
