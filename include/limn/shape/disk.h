/// \file
/// Disks.
#pragma once

#include "limn/shape/hittable.h"

namespace limn {

/// The points of the plane through `center` across `normal`, as far as `radius` from it, the rim included. The outward
/// side is the one that the normal, of any length, points to. A ray in the disk's own plane misses. u and v run from 0
/// to 1 over the square around the disk, along the tangents of Frame(normal).
class Disk final : public Hittable {
public:
    /// \throws ArgumentError if anything is not finite, the normal is zero, or the radius is not positive
    Disk(const Point3& center, const Vec3& normal, double radius, std::shared_ptr<const Material> material);
    Box bounds() const override;
    std::optional<Hit> hit(const Ray& ray) const override;
    void lower(RecordSink& sink) const override;

private:
    Point3 center_;
    Vec3 normal_;
    double radius_;
    std::shared_ptr<const Material> material_;
};

}  // namespace limn
