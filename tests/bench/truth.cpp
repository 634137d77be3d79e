#include "bench/truth.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "support/exact_truth.h"
#include "support/tally.h"

namespace limn::test {

namespace {

// All that doubles may be off by in what follows, many times over. What lies farther from a ray than this share of its
// distance needs no exact arithmetic to be missed.
constexpr double kMargin = 1e-6;

bool may_meet(const Point3& center, double radius, const Ray& ray) {
    const Vec3 to = center - ray.origin;
    const double along = dot(to, ray.direction) / length(ray.direction);
    const double far_off = std::sqrt(std::max(0.0, dot(to, to) - along * along));
    return far_off <= radius + kMargin * (length(to) + radius);
}

// By Moeller and Trumbore's formula, with a margin around the triangle.
bool may_meet(const Point3& a, const Point3& b, const Point3& c, const Ray& ray) {
    const Vec3 ab = b - a, ac = c - a, from = ray.origin - a;
    const Vec3 p = cross(ray.direction, ac), q = cross(from, ab);
    const double det = dot(ab, p), size = length(ab) * length(ac) * length(ray.direction);
    if (std::abs(det) <= kMargin * size) return true;
    const double u = dot(from, p) / det, v = dot(ray.direction, q) / det;
    // from, and with it u and v, is off by so much where the origin is far away.
    const double margin =
        1e-3 + 1e-12 * length(from) * (length(ab) + length(ac)) * length(ray.direction) / std::abs(det);
    return u >= -margin && v >= -margin && u + v <= 1 + margin;
}

class Truth {
public:
    explicit Truth(const bench::Geometry& geometry) : geometry_(geometry) {
        if (!geometry.mesh) return;
        const Box box = geometry.mesh->bounds();
        center_ = box.center();
        radius_ = length(box.diagonal()) / 2;
    }

    ExactHit nearest(const Ray& ray) {
        best_ = {};
        for (const bench::Ball& ball : geometry_.balls)
            if (may_meet(ball.center, ball.radius, ray)) take(exact_sphere_hit(ball.center, ball.radius, ray));
        for (const bench::Parallelogram& q : geometry_.quads) take(exact_quad_hit(q.corner, q.edge_u, q.edge_v, ray));
        if (geometry_.mesh && geometry_.places.empty()) mesh(ray, ray, {});
        for (const Transform& place : geometry_.places) {
            const double growth = std::sqrt(3) * longest_row(place);
            if (!may_meet(transform_point(place, center_), growth * radius_, ray)) continue;
            const Transform back = inverse(place);
            const Ray inside{transform_point(back, ray.origin), transform_vector(back, ray.direction)};
            mesh(ray, inside, std::span(&place, 1));
        }
        return best_;
    }

private:
    static double longest_row(const Transform& m) {
        double longest = 0;
        for (const auto& row : m.rows) longest = std::max(longest, length(Vec3(row[0], row[1], row[2])));
        return longest;
    }

    // `near` decides which triangles are worth an exact answer, which `ray` gets.
    void mesh(const Ray& ray, const Ray& near, std::span<const Transform> chain) {
        const MeshData& data = geometry_.mesh->data();
        const auto vertex = [&](std::uint32_t i) {
            const Float3& v = data.vertices[i];
            return Point3{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
        };
        for (const Index3& face : data.triangles) {
            const Point3 a = vertex(face.a), b = vertex(face.b), c = vertex(face.c);
            if (may_meet(a, std::max(length(b - a), length(c - a)), near) && may_meet(a, b, c, near))
                take(exact_triangle_hit(a, b, c, ray, chain));
        }
    }

    void take(const ExactHit& hit) {
        if (hit.hit && (!best_.hit || hit.t < best_.t)) best_ = hit;
    }

    const bench::Geometry& geometry_;
    Point3 center_;
    double radius_ = 0;
    ExactHit best_;
};

bool agrees(const ExactHit& truth, const std::optional<RayHit>& hit) {
    if (truth.hit != hit.has_value()) return false;
    return !hit || std::abs(hit->t - static_cast<double>(truth.t)) <= 0x1p-23 * hit->t;
}

}  // namespace

Verdict judge(const bench::Geometry& geometry, const CompiledScene& scene, const bench::RaySet& set,
              std::size_t sample) {
    Verdict verdict;
    Truth truth(geometry);
    const std::size_t step = std::max<std::size_t>(1, set.rays.size() / std::max<std::size_t>(1, sample));
    for (std::size_t i = 0; i < set.rays.size(); i += step) {
        const Ray& ray = set.rays[i];
        const ExactHit exact = truth.nearest(ray);
        ++verdict.rays;
        verdict.hits += exact.hit ? 1 : 0;
        const bool right = set.any ? scene.any_hit(ray) == exact.hit : agrees(exact, scene.closest_hit(ray));
        if (!right && verdict.wrong++ == 0) verdict.first = describe(ray);
    }
    return verdict;
}

}  // namespace limn::test
