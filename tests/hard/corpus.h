// A fixed scene and 1e5 fixed rays, the same bits in every build: drawn from std::mt19937_64 by whole numbers and by
// + - * / and square roots, which IEEE 754 rounds in one way only. Random::log_uniform and Transform::rotate are out of
// bounds here, for they ask the C library. Draws are statements of their own: the order in which the arguments of a
// call are evaluated is the compiler's choice.
#pragma once

#include <vector>

#include "support/scene_zoo.h"

namespace limn::test {

struct Corpus {
    Scene scene;
    std::vector<bool> round;     // per object: a sphere, perhaps instanced
    std::vector<Point3> points;  // vertices, corners, centres, poles, also of what is instanced
    struct Ball {
        Point3 center;
        double radius = 1;
    };
    std::vector<Ball> balls;  // for tangents

    void add(const Object& object, bool is_round = false) {
        scene.add(object);
        round.push_back(is_round);
    }
};

namespace corpus {

inline Point3 draw_point(Random& random, double half_side) { return Point3{} + random.in_cube(half_side); }

/// Anything but singular: the diagonal outweighs the rest of its row.
inline Transform draw_matrix(Random& random) {
    Transform m;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) m.rows[i][j] = random.uniform(-0.4, 0.4);
        m.rows[i][i] = random.uniform(1, 2);
        m.rows[i][3] = random.uniform(-4, 4);
    }
    return m;
}

inline void add_spheres(Corpus& c, Random& random) {
    const auto add = [&](const Point3& from, const Point3& to, double radius) {
        c.add(std::make_shared<Sphere>(from, to, radius, nullptr), true);
        c.balls.push_back({from, radius < 0 ? -radius : radius});
        for (const double sign : {-1.0, 1.0})
            for (std::size_t a = 0; a < 3; ++a) {
                c.points.push_back(from);
                c.points.back()[a] += sign * radius;
            }
    };
    add({0, -1000, 0}, {0, -1000, 0}, 996);
    for (int i = 0; i < 10; ++i) {
        const Point3 p = draw_point(random, 5);
        const double radius = random.uniform(0.1, 1.5);
        add(p, p, i % 5 == 4 ? -radius : radius);
    }
    for (int i = 0; i < 5; ++i) {
        const Point3 from = draw_point(random, 5);
        const Vec3 by = random.in_cube(2);
        add(from, from + by, random.uniform(0.1, 1));
    }
}

/// A fan, whose triangles share edges and a vertex, a sliver, and loose ones; quads; every fifth twice.
inline void add_flat_shapes(Corpus& c, Random& random) {
    const Point3 hub = draw_point(random, 4);
    Point3 spoke = draw_point(random, 5);
    for (int i = 0; i < 20; ++i) {
        const Point3 a = i < 10 ? hub : draw_point(random, 5), b = i < 10 ? spoke : draw_point(random, 5);
        const Point3 loose = draw_point(random, 5);
        const Point3 d = i == 12 ? a + 0.5 * (b - a) + 0x1p-20 * (loose - a) : loose;
        spoke = d;
        const auto triangle = std::make_shared<Triangle>(a, b, d, nullptr);
        c.points.insert(c.points.end(), {a, b, d, a + 0.5 * (b - a), b + 0.25 * (d - b)});
        c.add(triangle);
        if (i % 5 == 0) c.add(triangle);
    }
    for (int i = 0; i < 8; ++i) {
        const Point3 corner = draw_point(random, 5);
        const Vec3 u = random.in_cube(3);
        const Vec3 v = random.in_cube(3);
        c.add(std::make_shared<Quad>(corner, u, v, nullptr));
        c.points.insert(c.points.end(), {corner, corner + u, corner + v, corner + (u + v), corner + 0.5 * u});
    }
    c.add(make_box({-1, -1, -1}, {1.5, 0.25, 3}, nullptr));
    for (int i = 0; i < 8; ++i) c.points.push_back({i & 1 ? -1 : 1.5, i & 2 ? -1 : 0.25, i & 4 ? -1.0 : 3.0});
}

inline void add_meshes(Corpus& c) {
    for (const MeshData& data : {icosphere(2, 1.25, {2, 1, -1}), cube_mesh(2, {-3, 1, 1}), u_shape()}) {
        c.add(std::make_shared<Mesh>(data, nullptr));
        for (std::uint32_t i = 0; i < data.vertices.size(); i += 3) c.points.push_back(vertex(data, i));
    }
}

/// Nested to depth 4, moving, mirrored, turned by a quarter, each over a mesh, a sphere, a box and a triangle.
inline void add_instances(Corpus& c, Random& random) {
    const MeshData data = icosphere(1);
    const Object mesh = std::make_shared<Mesh>(data, nullptr);
    const Object triangle =
        std::make_shared<Triangle>(Point3{-1, 0, 0}, Point3{1, -0.5, 0.25}, Point3{0.5, 1, -0.75}, nullptr);
    const Object inner[4] = {mesh, ball({0, 0, 0}, 0.75), make_box({0, 0, 0}, {1, 1, 1}, nullptr), triangle};
    for (int i = 0; i < 16; ++i) {
        Object object = inner[i % 4];
        Transform whole;
        for (int level = 0; level <= i / 4; ++level) {
            Transform m = draw_matrix(random);
            if (level > 0) m = Transform::translate({-m.rows[0][3], 0, 1}) * Transform::scale(0.75, 0.5, 0.75) * m;
            if (i % 3 == 1) m = m * Transform::scale(-1, 1, 1);
            if (i % 3 == 2) m = m * Transform::rotate_y(90);
            const Vec3 by = random.in_cube(1);
            object = (i + level) % 3 == 0 ? std::make_shared<Instance>(object, m, Transform::translate(by) * m)
                                          : std::make_shared<Instance>(object, m);
            whole = m * whole;
        }
        c.add(object, i % 4 == 1);
        for (std::uint32_t k = 0; k < data.vertices.size(); k += 5)
            c.points.push_back(transform_point(whole, vertex(data, k)));
        for (const Point3& p : {Point3{0, 0, 0}, Point3{1, 1, 0}, Point3{1, -0.5, 0.25}})
            c.points.push_back(transform_point(whole, p));
    }
    for (const Transform& m : {Transform{}, Transform::scale(-1, 1, 1), Transform::rotate_y(90)})
        c.add(std::make_shared<Instance>(mesh, m));  // these overlap in many vertices
}

/// Walls of quads around a mesh: shapes in a list beside a tree.
inline void add_room(Corpus& c, Random& random) {
    add_meshes(c);
    const Vec3 side[3] = {{40, 0.125, 0}, {0, 40, 0.25}, {0.5, 0, 40}};
    for (std::size_t a = 0; a < 3; ++a)
        for (const double sign : {-1.0, 1.0}) {
            const Vec3 &u = side[a], &v = side[(a + 1) % 3];
            Point3 center = draw_point(random, 1);
            center[(a + 2) % 3] += sign * 9;
            c.add(std::make_shared<Quad>(center - 0.5 * u - 0.5 * v, u, v, nullptr));
            c.points.push_back(center);
        }
}

}  // namespace corpus

inline Corpus make_corpus() {
    Random random(20260501);
    Corpus c;
    corpus::add_spheres(c, random);
    corpus::add_flat_shapes(c, random);
    corpus::add_meshes(c);
    corpus::add_instances(c, random);
    return c;
}

/// The same, of some kinds of shape alone: compiled scenes have code of their own for these.
struct CorpusPart {
    const char* name;
    void (*add)(Corpus&, Random&);
    std::string hits;  // the digest of the answers
};

/// Ray number `i` of the corpus; every tenth is of the same kind.
inline Ray corpus_ray(const Corpus& c, Random& random, int i) {
    const auto target = [&] { return c.points[random.index(c.points.size())]; };
    const auto zero = [&] { return random.chance(0.5) ? 0.0 : -0.0; };
    const auto two_to = [&](int first, int last) {
        return std::ldexp(1.0, first + static_cast<int>(random.index(static_cast<std::size_t>(last - first + 1))));
    };

    Ray ray;
    ray.origin = corpus::draw_point(random, 12);
    const Point3 p = target();
    switch (i % 10) {
        case 0: ray.direction = random.unit(); break;
        case 1: ray.direction = p - ray.origin; break;
        case 2: {  // parallel to an axis
            const std::size_t axis = random.index(3);
            const double towards = p[axis] < ray.origin[axis] ? -1 : 1;
            for (std::size_t a = 0; a < 3; ++a) {
                ray.direction[a] = a == axis ? towards : zero();
                if (a != axis) ray.origin[a] = p[a];
            }
            break;
        }
        case 3: {  // in a plane of the axes
            const std::size_t axis = random.index(3);
            ray.origin[axis] = p[axis];
            ray.direction = p - ray.origin;
            ray.direction[axis] = zero();
            break;
        }
        case 4:
            ray.origin = p;
            ray.direction = random.unit();
            break;
        case 5:  // along edges and diagonals
            ray.direction = p - target();
            ray.origin = p - 2 * ray.direction;
            break;
        case 6:
            ray.direction = p - ray.origin;
            ray.direction = two_to(-100, 80) * ray.direction;
            break;
        case 7: {  // from far away
            const Vec3 away = random.unit();
            ray.origin = p + two_to(5, 24) * away;
            ray.direction = p - ray.origin;
            break;
        }
        case 8: {  // just beside it
            const Vec3 aside = random.unit();
            ray.direction = p + two_to(-50, -3) * aside - ray.origin;
            break;
        }
        default: {  // tangent to a sphere
            const Corpus::Ball& ball = c.balls[random.index(c.balls.size())];
            const Vec3 n = random.unit(), along = cross(n, random.unit());
            ray.direction = along;
            ray.origin = ball.center + ball.radius * n - random.uniform(1, 8) * along;
            break;
        }
    }
    if (ray.direction == Vec3{}) ray.direction = {0, 0, 1};
    if (i % 7 == 3) ray.t_max = random.uniform(0, 2);
    if (i % 7 == 5) ray.t_min = random.uniform(-1, 1);
    ray.time = random.uniform(-0.25, 1.25);
    return ray;
}

}  // namespace limn::test
