/// \file
/// Triangles.
#pragma once

#include "limn/scene/shape/hittable.h"

namespace limn {

/// A flat triangle with vertices in double precision. u and v are the barycentric weights of b and c. The outward
/// normal is (b - a) x (c - a). A ray in the plane of the triangle misses.
class Triangle final : public BuiltInShape {
public:
    /// \param material may be null in scenes that are queried and not rendered
    ///
    /// \throws ArgumentError if a vertex is not finite, or the area is exactly zero
    Triangle(const Point3& a, const Point3& b, const Point3& c, std::shared_ptr<const Material> material);
    void lower(RecordSink& sink) const override;

private:
    Box box() const override;
    std::optional<Hit> intersect(const Ray& ray) const override;

    Point3 a_, b_, c_;
    std::shared_ptr<const Material> material_;
};

}  // namespace limn
