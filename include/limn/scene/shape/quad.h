/// \file
/// Parallelograms and boxes.
#pragma once

#include <array>

#include "limn/scene/shape/hittable.h"

namespace limn {

/// The parallelogram corner + u edge_u + v edge_v with u and v in [0, 1]. Its outward normal is edge_u x edge_v. A ray
/// in the plane of the quad misses.
class Quad final : public BuiltInShape {
public:
    /// \param material may be null in scenes that are queried and not rendered
    ///
    /// \throws ArgumentError if a number is not finite, an edge is zero, or the edges are parallel
    Quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, std::shared_ptr<const Material> material);
    void lower(RecordSink& sink) const override;

private:
    Box box() const override;
    std::optional<Hit> intersect(const Ray& ray) const override;

    Point3 corner_;
    Vec3 edge_u_, edge_v_;
    std::shared_ptr<const Material> material_;
};

class HittableList;

/// Returns the six quads of an axis-aligned box: front (+z), right (+x), back, left, top (+y), bottom. Their normals
/// point outward.
///
/// \param corner,opposite two opposite corners of the box, in either order
///
/// \throws ArgumentError if the box is flat or not finite
std::shared_ptr<HittableList> make_box(const Point3& corner, const Point3& opposite,
                                       const std::shared_ptr<const Material>& material);

}  // namespace limn
