/// \file
/// Parallelograms and boxes.
#pragma once

#include <array>

#include "limn/shape/hittable.h"

namespace limn {

/// A parallelogram: corner + u edge_u + v edge_v, u and v in [0, 1]. The outward normal is edge_u x edge_v. A ray in
/// the quad's own plane misses.
class Quad final : public Hittable {
public:
    /// \throws ArgumentError if anything is not finite, an edge is zero, or the edges are parallel
    Quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, std::shared_ptr<const Material> material);
    Box bounds() const override;
    std::optional<Hit> hit(const Ray& ray) const override;
    void lower(RecordSink& sink) const override;

private:
    Point3 corner_;
    Vec3 edge_u_, edge_v_;
    std::shared_ptr<const Material> material_;
};

class HittableList;
/// The six quads of an axis-aligned box, normals outward: front (+z), right (+x), back, left, top (+y), bottom.
/// \throws ArgumentError if the box is flat or not finite
std::shared_ptr<HittableList> make_box(const Point3& corner, const Point3& opposite,
                                       const std::shared_ptr<const Material>& material);

}  // namespace limn
