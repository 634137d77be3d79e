// Shapes and rays for properties, on numbers of few bits (grid.h).
#pragma once

#include <memory>
#include <optional>

#include "limn/scene/shape/mesh.h"
#include "limn/scene/shape/quad.h"
#include "limn/scene/shape/sphere.h"
#include "limn/scene/shape/triangle.h"
#include "support/grid.h"
#include "support/meshes.h"

namespace limn::test {

enum class Kind { sphere, triangle, quad, mesh };

// A shape at p, spanned by e and f, and a ray that is aimed at it more often than not.
struct Case {
    Kind kind = Kind::sphere;
    Point3 p;
    Vec3 e, f;
    double radius = 1;
    Ray ray;

    std::shared_ptr<const Hittable> shape() const {
        switch (kind) {
            case Kind::sphere: return std::make_shared<Sphere>(p, radius, nullptr);
            case Kind::triangle: return std::make_shared<Triangle>(p, p + e, p + f, nullptr);
            case Kind::quad: return std::make_shared<Quad>(p, e, f, nullptr);
            case Kind::mesh: {
                MeshData data;
                for (const Vec3& v : {Vec3{}, e, f}) data.vertices.push_back(to_float3((p + v) - Point3{}));
                data.triangles = {{0, 1, 2}};
                return std::make_shared<Mesh>(data, nullptr);
            }
        }
        return nullptr;
    }
    std::optional<Hit> hit() const { return shape()->hit(ray); }

    // The same elsewhere, and at another size; the direction stays as it is.
    Case moved(const Vec3& by) const {
        Case c = *this;
        c.p = p + by, c.ray.origin = ray.origin + by;
        return c;
    }
    Case scaled(double s) const {
        Case c = *this;
        c.p = Point3{} + s * (p - Point3{}), c.e = s * e, c.f = s * f, c.radius = s * radius;
        c.ray.origin = Point3{} + s * (ray.origin - Point3{});
        return c;
    }
};

// One component in four is zero: edges along the axes and in their planes are cases of their own.
inline Vec3 draw_edge() {
    Vec3 e = draw_vec();
    for (std::size_t a = 0; a < 3; ++a)
        if (draw_int(0, 3) == 3) e[a] = 0;
    return e;
}

inline Case draw_case() {
    Case c;
    c.kind = static_cast<Kind>(draw_int(0, 3));
    c.p = draw_point();
    c.e = draw_edge(), c.f = draw_edge();
    c.radius = draw_int(1, 512) / 64.0;
    if (draw_int(0, 4) == 0) c.radius = -c.radius;
    RC_PRE(!(cross(c.e, c.f) == Vec3{}));
    const Vec3 inside = draw_int(0, 4) / 4.0 * c.e + draw_int(0, 4) / 4.0 * c.f;
    c.ray.origin = draw_point();
    c.ray.direction = c.p + (c.kind == Kind::sphere ? draw_vec(256) : inside) - c.ray.origin;
    RC_PRE(!(c.ray.direction == Vec3{}));
    return c;
}

}  // namespace limn::test
