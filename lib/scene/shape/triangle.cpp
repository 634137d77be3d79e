#include "limn/scene/shape/triangle.h"

#include "geometry/hit_error.h"
#include "geometry/intersect.h"
#include "geometry/mesh_triangle.h"
#include "math/float_environment.h"
#include "scene/shape/arguments.h"

namespace limn {

Triangle::Triangle(const Point3& a, const Point3& b, const Point3& c, std::shared_ptr<const Material> material)
    : a_(a), b_(b), c_(c), material_(std::move(material)) {
    const FloatEnvironment environment;
    for (const Point3& p : {a, b, c}) require_finite(p, "Triangle", "a vertex");
    if (are_collinear(a, b, c)) throw ArgumentError("Triangle: the area must not be zero");
}

Box Triangle::box() const { return triangle_bounds({a_, b_, c_}); }

std::optional<Hit> Triangle::intersect(const Ray& ray) const {
    PlanarHit hit;
    if (!intersect_triangle(a_, b_, c_, frame_of(ray), {ray.t_min, ray.t_max}, hit)) return std::nullopt;
    return Hit{.t = hit.t,
               .normal = triangle_normal(a_, b_, c_),
               .u = hit.u,
               .v = hit.v,
               .material = material_.get(),
               .position_error = planar_error(a_, b_ - a_, c_ - a_)};
}

void Triangle::lower(RecordSink& sink) const { sink.triangle({a_, b_, c_, lower_material(sink, material_)}); }

}  // namespace limn
