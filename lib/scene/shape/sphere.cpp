#include "limn/scene/shape/sphere.h"

#include <cmath>

#include "geometry/bounds.h"
#include "geometry/intersect.h"
#include "math/sphere_uv.h"
#include "scene/shape/arguments.h"

namespace limn {

Sphere::Sphere(const Point3& center, double radius, std::shared_ptr<const Material> material)
    : Sphere(center, center, radius, std::move(material)) {}

Sphere::Sphere(const Point3& center0, const Point3& center1, double radius, std::shared_ptr<const Material> material)
    : center0_(center0), center1_(center1), radius_(radius), material_(std::move(material)) {
    require_finite(center0, "Sphere", "the centre");
    require_finite(center1, "Sphere", "the centre at time 1");
    if (!std::isfinite(radius) || radius == 0) throw ArgumentError("Sphere: the radius must be finite and not zero");
}

Point3 Sphere::center(double time) const {
    return center0_ == center1_ ? center0_ : interpolate(center0_, center1_, time);  // a still centre isn't rounded
}

Box Sphere::box() const { return sphere_bounds(center0_, center1_, radius_); }

std::optional<Hit> Sphere::intersect(const Ray& ray) const {
    const Point3 c = center(ray.time);
    PlanarHit found;
    if (!intersect_sphere(c, std::abs(radius_), frame_of(ray), {ray.t_min, ray.t_max}, found)) return std::nullopt;
    const Vec3 outward = sphere_normal(c, ray, found.t);
    const Uv uv = sphere_uv(radius_ < 0 ? -outward : outward);
    return Hit{.t = found.t,
               .normal = Normal3(radius_ < 0 ? -outward : outward),
               .u = uv.u,
               .v = uv.v,
               .material = material_.get(),
               .position_error = sphere_error(c, radius_)};
}

void Sphere::lower(RecordSink& sink) const {
    sink.sphere({center0_, center1_, radius_, lower_material(sink, material_)});
}

}  // namespace limn
