/// \file
/// Spheres.
#pragma once

#include "limn/shape/hittable.h"

namespace limn {

/// A sphere, still or with its centre moving on a straight line over the shutter. u and v are the spherical
/// coordinates of the outward unit normal n: u = (atan2(-n.z, n.x) + pi) / 2 pi, v = acos(-n.y) / pi, so that v runs
/// from 0 at -y to 1 at +y, and u from 0 at -x around through +z (1/4), +x (1/2), -z (3/4).
class Sphere final : public Hittable {
public:
    /// A negative radius turns the normal inward (the inside of hollow glass), and u and v with it. A null material is
    /// enough to be hit, not to be rendered.
    ///
    /// \throws ArgumentError if the radius is zero, or anything is not finite
    Sphere(const Point3& center, double radius, std::shared_ptr<const Material> material);
    /// Centre center0 at time 0, center1 at time 1, bit-exact at both; times outside are clamped.
    ///
    /// \throws ArgumentError if the radius is zero, or anything is not finite
    Sphere(const Point3& center0, const Point3& center1, double radius, std::shared_ptr<const Material> material);

    Point3 center(double time) const;          ///< at a time in shutter units
    double radius() const { return radius_; }  ///< as given, perhaps negative
    Box bounds() const override;
    std::optional<Hit> hit(const Ray& ray) const override;
    void lower(RecordSink& sink) const override;

private:
    Point3 center0_, center1_;
    double radius_;
    std::shared_ptr<const Material> material_;
};

}  // namespace limn
