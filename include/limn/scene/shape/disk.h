/// \file
/// Disks.
#pragma once

#include "limn/scene/shape/hittable.h"

namespace limn {

/// The points of a plane at a distance of at most `radius` from `center`. The plane is perpendicular to `normal`, which
/// points outward. A ray in that plane misses. u and v run from 0 to 1 over the square around the disk, along the
/// tangents Frame::x and Frame::y of the unit normal.
class Disk final : public BuiltInShape {
public:
    /// \param normal of any length but zero
    /// \param radius above 0
    /// \param material may be null in scenes that are queried and not rendered
    ///
    /// \throws ArgumentError if a number is not finite, the normal is zero, or the radius is not positive
    Disk(const Point3& center, const Vec3& normal, double radius, std::shared_ptr<const Material> material);
    void lower(RecordSink& sink) const override;

private:
    Box box() const override;
    std::optional<Hit> intersect(const Ray& ray) const override;

    Point3 center_;
    Vec3 normal_;
    double radius_;
    std::shared_ptr<const Material> material_;
};

}  // namespace limn
