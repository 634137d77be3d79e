// What rays are made to leave from: shapes of one size at one place, points of them away from creases, directions.
#pragma once

#include <optional>
#include <string>

#include "hard/hard.h"
#include "support/scene_zoo.h"

namespace limn::test {

enum class SubjectKind {
    sphere,
    triangle,
    quad,
    box,
    mesh,
    instanced_sphere,
    instanced_quad,
    instanced_mesh,
    moving_sphere,
    moving_mesh
};

/// A shape that is convex, or flat. A ray that leaves outward never meets it again; one that leaves inward meets it
/// once, if it is closed.
class Subject {
public:
    Subject(SubjectKind kind, double scale, const Point3& place, Random& random) : kind_(kind), scale_(scale) {
        const Vec3 shift = place - Point3{};
        const Transform turned =
            Transform::translate(shift) * Transform::rotate({1, 2, 3}, 33) * Transform::scale(scale, scale, scale);
        const Transform inner = Transform::rotate({3, 1, 2}, 50) * Transform::scale(-1, 0.5, 2);
        const Transform later = Transform::translate(scale * random.unit()) * turned * Transform::rotate_y(20);
        const auto instanced = [&](const Object& object, const Transform& at1) {
            return std::make_shared<Instance>(std::make_shared<Instance>(object, inner), turned, at1);
        };
        const Point3 corner = place + random.in_cube(scale);
        const Vec3 e = scale * random.unit(), f = normalize(cross(e, random.unit())) * scale + 0.5 * e;
        switch (kind) {
            case SubjectKind::sphere: object_ = ball(place, scale), sphere_ = true; break;
            case SubjectKind::triangle:
                object_ = std::make_shared<Triangle>(corner, corner + e, corner + f, nullptr);
                faces_ = {{corner, e, f}};
                break;
            case SubjectKind::quad:
                object_ = std::make_shared<Quad>(corner, e, f, nullptr);
                faces_ = {{corner, e, f}};
                break;
            case SubjectKind::box:
                object_ = make_box(place, place + Vec3{scale, scale, 0.5 * scale}, nullptr);
                add_faces(cube_mesh(), Transform::translate(shift) * Transform::scale(scale, scale, 0.5 * scale));
                break;
            case SubjectKind::mesh:
                object_ = std::make_shared<Mesh>(icosphere(1, scale, shift), nullptr);
                add_faces(static_cast<const Mesh&>(*object_).data(), Transform{});
                break;
            case SubjectKind::instanced_sphere:
            case SubjectKind::moving_sphere: {
                const bool moving = kind == SubjectKind::moving_sphere;
                object_ = instanced(ball({0, 0, 0}, 1), moving ? later : turned);
                to_world_ = interpolate(turned, moving ? later : turned, time()) * inner, sphere_ = true;
                break;
            }
            case SubjectKind::instanced_quad: {
                const Point3 p{-0.5, 0.25, 0.1};
                const Vec3 u{1, 0, 0.3}, v{0, 1, 0.2};
                const Transform m = turned * inner;
                object_ = instanced(std::make_shared<Quad>(p, u, v, nullptr), turned);
                faces_ = {{transform_point(m, p), transform_vector(m, u), transform_vector(m, v)}};
                break;
            }
            case SubjectKind::instanced_mesh:
            case SubjectKind::moving_mesh: {
                const Transform at1 = kind == SubjectKind::moving_mesh ? later : turned;
                object_ = instanced(std::make_shared<Mesh>(icosphere(1), nullptr), at1);
                add_faces(icosphere(1), interpolate(turned, at1, time()) * inner);
                break;
            }
        }
        if (kind == SubjectKind::sphere)
            to_world_ = Transform::translate(shift) * Transform::scale(scale, scale, scale);
        compiled_ = std::make_unique<CompiledScene>(compile(zoo_of("one", {object_}).scene));
    }

    std::string name() const { return "kind " + std::to_string(static_cast<int>(kind_)); }
    bool is_closed() const { return sphere_ || faces_.size() > 1; }
    double time() const { return 0.375; }
    const CompiledScene& compiled() const { return *compiled_; }

    /// A point that a ray reaches from outside, at an angle; counted.
    std::optional<Surface> reach(Random& random, Tally& tally) const {
        ++tally.rays, ++tally.judged;
        Point3 target;
        Vec3 outward;
        if (sphere_) {
            const Vec3 n = random.unit();
            target = transform_point(to_world_, Point3{} + n);
            outward = Vec3(transform_normal(inverse(to_world_), Normal3(n)));
        } else {
            const Face& face = faces_[random.index(faces_.size())];
            const double u = random.uniform(0.02, 0.96), v = random.uniform(0.02, 0.98 - u);
            target = face.corner + (u * face.e + v * face.f);
            outward = cross(face.e, face.f);
            if (!is_closed() && random.chance(0.5)) outward = -outward;
        }
        Vec3 from;
        do from = random.unit();
        while (dot(from, normalize(outward)) < 0.05);
        Ray ray;
        ray.origin = target + random.uniform(4, 10) * scale_ * from;
        ray.direction = random.log_uniform(0.1, 10) * (target - ray.origin);
        ray.time = time();
        const auto hit = compiled_->closest_hit(ray);
        if (!hit) {
            tally.fault(ray, "not reached");
            return std::nullopt;
        }
        ++tally.hits;
        return compiled_->surface_at(ray, *hit);
    }

    /// Counts a fault where a spawned ray does not behave, in either world.
    void judge(const Ray& ray, bool inside, Tally& tally) const {
        const auto hit = compiled_->closest_hit(ray);
        if (hit.has_value() != inside) tally.fault(ray, inside ? "exit lost" : "hit again");
        if (object_->hit(ray).has_value() != inside) tally.fault(ray, inside ? "exit lost" : "hit again");
        if (hit && inside && compiled_->surface_at(ray, *hit).front_face) tally.fault(ray, "exit seen from outside");
    }

private:
    struct Face {
        Point3 corner;
        Vec3 e, f;
    };
    void add_faces(const MeshData& mesh, const Transform& m) {
        for (const Index3& t : mesh.triangles) {
            const Point3 a = vertex(mesh, t.a);
            faces_.push_back({transform_point(m, a), transform_vector(m, vertex(mesh, t.b) - a),
                              transform_vector(m, vertex(mesh, t.c) - a)});
        }
        if (determinant(m) < 0)  // seen from outside the other way round
            for (Face& face : faces_) std::swap(face.e, face.f);
    }

    SubjectKind kind_;
    double scale_;
    bool sphere_ = false;
    Transform to_world_;       // of a sphere: from the unit sphere
    std::vector<Face> faces_;  // corner + u e + v f, u + v <= 1, outward e x f; none for a sphere
    Object object_;
    std::unique_ptr<const CompiledScene> compiled_;
};

/// On the side of the normal (1) or on the other (-1), one in three grazing.
inline Vec3 leaving_direction(Random& random, const Normal3& n, double side) {
    Vec3 d = random.unit();
    if (random.chance(0.3)) d = d - (1 - random.log_uniform(1e-9, 1)) * dot(n, d) * Vec3(n);
    d = normalize(d);
    return side * dot(n, d) < 0 ? -d : d;
}

}  // namespace limn::test
