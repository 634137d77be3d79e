/// \file
/// Triangles.
#pragma once

#include "limn/shape/hittable.h"

namespace limn {

/// A flat triangle in double. u and v are the weights of b and c. The outward normal is (b - a) x (c - a). A ray in the
/// triangle's own plane misses.
class Triangle final : public Hittable {
public:
    /// \throws ArgumentError if a vertex is not finite or the area is exactly zero
    Triangle(const Point3& a, const Point3& b, const Point3& c, std::shared_ptr<const Material> material);
    Box bounds() const override;
    std::optional<Hit> hit(const Ray& ray) const override;
    void lower(RecordSink& sink) const override;

private:
    Point3 a_, b_, c_;
    std::shared_ptr<const Material> material_;
};

}  // namespace limn
