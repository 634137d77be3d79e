// A simple shape seen through a chain of matrices: as limn describes it, and its exact answers.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "hard/hard.h"
#include "limn/scene/shape/instance.h"
#include "support/scene_zoo.h"

namespace limn::test {

struct Placed {
    enum class Kind { sphere, triangle, quad, mesh } kind = Kind::sphere;
    Point3 p{0, 0, 0};  // centre, first vertex, corner
    Vec3 e{}, f{};      // edges
    double radius = 1;
    MeshData mesh{};
    std::vector<Transform> chain{};  // world from object, outermost first

    Object shape() const {
        switch (kind) {
            case Kind::sphere: return std::make_shared<Sphere>(p, radius, nullptr);
            case Kind::triangle: return std::make_shared<Triangle>(p, p + e, p + f, nullptr);
            case Kind::quad: return std::make_shared<Quad>(p, e, f, nullptr);
            case Kind::mesh: return std::make_shared<Mesh>(mesh, nullptr);
        }
        return nullptr;
    }
    Object object() const {
        Object object = shape();
        for (std::size_t i = chain.size(); i-- > 0;) object = std::make_shared<Instance>(object, chain[i]);
        return object;
    }

    Placed shape_alone() const {
        Placed alone = *this;
        alone.chain.clear();
        return alone;
    }

    /// Through the chain, rounded.
    Point3 to_world(Point3 local) const {
        for (std::size_t i = chain.size(); i-- > 0;) local = transform_point(chain[i], local);
        return local;
    }
    /// Vertices, corners, poles: what rays are aimed at, in the world.
    std::vector<Point3> awkward_points() const {
        std::vector<Point3> points;
        if (kind == Kind::sphere)
            for (std::size_t a = 0; a < 3; ++a)
                for (const double sign : {-1.0, 1.0}) {
                    points.push_back(p);
                    points.back()[a] += sign * radius;
                }
        if (kind == Kind::triangle || kind == Kind::quad) points = {p, p + e, p + f};
        if (kind == Kind::quad) points.push_back(p + (e + f));
        for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) points.push_back(vertex(mesh, i));
        for (Point3& point : points) point = to_world(point);
        return points;
    }
    /// A point of an edge, of the border of a sphere seen from anywhere, or within, rounded.
    Point3 point_on(Random& random, bool on_edge) const {
        if (kind == Kind::sphere) return to_world(p + (on_edge ? 1 : random.uniform()) * radius * random.unit());
        const double u = random.uniform(), v = on_edge ? static_cast<double>(random.index(2)) : random.uniform();
        if (kind == Kind::mesh) {
            const Index3 t = mesh.triangles[random.index(mesh.triangles.size())];
            const Point3 a = vertex(mesh, t.a), b = vertex(mesh, t.b), c = vertex(mesh, t.c);
            return to_world(on_edge ? a + u * (b - a) : a + u * (1 - v) * (b - a) + v * (c - a));
        }
        if (kind == Kind::quad) return to_world(p + (u * e + v * f));
        return to_world(on_edge ? p + (u * e + (1 - u) * f) : p + (u * (1 - v) * e + v * f));
    }

    /// The exact answer; of a mesh, the nearest triangle's.
    ExactHit exact(const Ray& ray) const {
        switch (kind) {
            case Kind::sphere: return exact_sphere_hit(p, radius, ray, chain);
            case Kind::triangle: return exact_triangle_hit(p, p + e, p + f, ray, chain);
            case Kind::quad: return exact_quad_hit(p, e, f, ray, chain);
            case Kind::mesh: break;
        }
        ExactHit nearest;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            if (const ExactHit hit = exact_element(i, ray); hit.hit && (!nearest.hit || hit.t < nearest.t))
                nearest = hit;
        return nearest;
    }
    ExactHit exact_element(std::uint64_t element, const Ray& ray) const {
        const Index3 t = mesh.triangles[element];
        return exact_triangle_hit(vertex(mesh, t.a), vertex(mesh, t.b), vertex(mesh, t.c), ray, chain);
    }
    bool has_uv() const { return kind == Kind::triangle || kind == Kind::quad; }
};

/// Judges both worlds on one ray. Of a mesh, u and v are those of the triangle that is said to be hit: at an edge
/// either neighbour is right.
inline void judge(Tally& tally, const Placed& placed, const BothWorlds& worlds, const Ray& ray) {
    const auto limn = [&](const Ray& r) { return worlds.hit(r, tally); };
    const auto exact = [&](const Ray& r) { return placed.exact(r); };
    judge(tally, ray, exact, limn, {.t_ulps = 1, .uv = placed.has_uv() ? 0x1p-23 : -1});
    if (placed.kind != Placed::Kind::mesh) return;
    Ray around = ray;  // decided above
    around.t_min = -kInfinity, around.t_max = kInfinity;
    if (const auto hit = limn(ray))
        if (const ExactHit own = placed.exact_element(hit->element, around);
            !own.hit || absolute(Real(hit->u) - own.u) > Real(0x1p-23) ||
            absolute(Real(hit->v) - own.v) > Real(0x1p-23))
            tally.fault(ray, "element, u, v");
}

/// A ray at an awkward point, at an edge, beside one, along one or within, from about `reach` away.
inline Ray aimed_ray(Random& random, const Placed& placed, const std::vector<Point3>& points, double reach) {
    Point3 target =
        random.chance(0.4) ? points[random.index(points.size())] : placed.point_on(random, random.chance(0.6));
    if (random.chance(0.2)) target = target + reach * random.log_uniform(1e-16, 1e-1) * random.unit();
    Ray ray;
    ray.origin = target + reach * random.uniform(0.1, 3) * random.unit();
    if (random.chance(0.1)) ray.origin = points[random.index(points.size())];  // along an edge, or from it
    ray.direction = random.log_uniform(1e-3, 1e3) * (target - ray.origin);
    if (random.chance(0.1)) ray.direction[random.index(3)] = random.chance(0.5) ? 0.0 : -0.0;
    if (ray.direction == Vec3{}) ray.direction = {0, -1, 0};
    if (random.chance(0.1)) ray.t_min = -kInfinity;
    return ray;
}

}  // namespace limn::test
