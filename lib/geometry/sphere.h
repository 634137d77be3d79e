// Still and moving spheres as primitives.
#pragma once

#include <tuple>

#include "geometry/primitive.h"
#include "math/sphere_uv.h"

namespace limn::primitives {

// A still sphere. Unlike a SphereRecord it stores a single centre.
struct Sphere : Primitive {
    static constexpr PrimitiveKind kKind = PrimitiveKind::sphere;
    static constexpr const char* kName = "sphere";
    static constexpr auto kRecords = &SceneRecords::spheres;
    static auto fields(const SphereRecord& s) { return std::tie(s.center0, s.center1, s.radius, s.material); }

    Point3 center;
    double radius;  // the normal points inward if this is negative
    MaterialId material;

    explicit Sphere(const SphereRecord& s) : center(s.center0), radius(s.radius), material(s.material) {}

    Box bounds() const { return sphere_bounds(center, center, radius); }
    double packed_error() const { return float_error(center); }
    std::array<float, 4> pack() const { return to_floats(center.x, center.y, center.z, std::abs(radius)); }
    SphereRecord ball() const { return {center, center, radius, material}; }
    void surface(const Ray& ray, const PlanarHit& found, bool with_uv, Surface& s) const {
        const Vec3 outward = sphere_normal(center, ray, found.t);
        s.position = center + std::abs(radius) * outward;
        s.position_error = sphere_error(center, radius);
        s.normal = s.shading_normal = Normal3((radius < 0 ? -1.0 : 1.0) * outward);
        if (with_uv) s.uv = sphere_uv(Vec3(s.normal));
    }
    // These are the derivatives of the position by u and v of sphere_uv. The normal is (sin(pi v) cos(phi), -cos(pi v),
    // -sin(pi v) sin(phi)), where phi = 2 pi u - pi. At the poles, dp_dv is set to 0.
    void tangents(Surface& s) const {
        const Vec3 n(s.normal);
        const double sine = std::sqrt(n.x * n.x + n.z * n.z);
        s.dp_du = (2 * kPi * radius) * Vec3{n.z, 0, -n.x};
        s.dp_dv = sine > 0 ? (kPi * radius) * Vec3{-n.y * n.x / sine, sine, -n.y * n.z / sine} : Vec3{};
    }
};

struct MovingSphere : SphereRecord, Primitive {
    static constexpr PrimitiveKind kKind = PrimitiveKind::moving_sphere;
    static constexpr const char* kName = "moving-sphere";
    static constexpr auto kRecords = &SceneRecords::spheres;

    explicit MovingSphere(const SphereRecord& s) : SphereRecord(s) {}

    Box bounds() const { return sphere_bounds(center0, center1, radius); }
    Sphere at(double time) const {
        const Point3 center = interpolate(center0, center1, time);
        return Sphere({center, center, radius, material});
    }
    // The second term covers the three roundings of the interpolation between two centres of floats.
    double packed_error() const {
        return std::max(float_error(center0), float_error(center1)) +
               0x1p-22 * std::max(max_abs(center0), max_abs(center1));
    }
    std::array<float, 7> pack() const {
        return to_floats(center0.x, center0.y, center0.z, center1.x, center1.y, center1.z, std::abs(radius));
    }
    SphereRecord ball() const { return *this; }
    void surface(const Ray& ray, const PlanarHit& found, bool with_uv, Surface& s) const {
        at(ray.time).surface(ray, found, with_uv, s);
    }
    void tangents(Surface& s) const { Sphere(*this).tangents(s); }
};

}  // namespace limn::primitives
