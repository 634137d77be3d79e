/// \file
/// Spheres.
#pragma once

#include "limn/scene/shape/hittable.h"

namespace limn {

/// A sphere, which is still or whose centre moves on a straight line from time 0 to time 1. u and v are the spherical
/// coordinates of n = Hit::normal: u = (atan2(-n.z, n.x) + pi) / (2 pi) and v = acos(-n.y) / pi. v runs from 0 at -y to
/// 1 at +y. u runs from 0 at -x through 1/4 at +z, 1/2 at +x and 3/4 at -z.
class Sphere final : public BuiltInShape {
public:
    /// Makes a sphere that doesn't move.
    ///
    /// \param radius not zero. A negative radius turns the normal inward, as for the inner surface of hollow glass.
    /// \param material may be null in scenes that are queried and not rendered
    ///
    /// \throws ArgumentError if the radius is zero, or a number is not finite
    Sphere(const Point3& center, double radius, std::shared_ptr<const Material> material);
    /// Makes a sphere whose centre is exactly center0 at time 0 and exactly center1 at time 1. Times outside [0, 1] are
    /// clamped. The other parameters and the errors are as above.
    Sphere(const Point3& center0, const Point3& center1, double radius, std::shared_ptr<const Material> material);

    Point3 center(double time) const;          ///< centre at a time, which is clamped to [0, 1]
    double radius() const { return radius_; }  ///< as given; may be negative
    void lower(RecordSink& sink) const override;

private:
    Box box() const override;
    std::optional<Hit> intersect(const Ray& ray) const override;

    Point3 center0_, center1_;
    double radius_;
    std::shared_ptr<const Material> material_;
};

}  // namespace limn
