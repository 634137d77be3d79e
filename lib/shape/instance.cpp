#include "limn/shape/instance.h"

#include <array>

#include "core/bounds.h"
#include "core/object_ray.h"
#include "shape/arguments.h"

namespace limn {

namespace {

using Cubic = std::array<double, 4>;

// The determinant of (1-t) A + t B is a cubic in t; its Bernstein coefficients from its values at 0, 1/3, 2/3, 1.
Cubic determinant_over_time(const Transform& a, const Transform& b) {
    const double f0 = determinant(a), f1 = determinant(interpolate(a, b, 1.0 / 3));
    const double f2 = determinant(interpolate(a, b, 2.0 / 3)), f3 = determinant(b);
    return {f0, (-5 * f0 + 18 * f1 - 9 * f2 + 2 * f3) / 6, (2 * f0 - 9 * f1 + 18 * f2 - 5 * f3) / 6, f3};
}

// A polynomial lies in the hull of its Bernstein coefficients: of one sign, they exclude a root. Else halve by de
// Casteljau's rule; what is still undecided after 40 halvings touches zero for all that doubles can tell.
bool has_root(const Cubic& c, int halvings = 40) {
    if ((c[0] > 0 && c[1] > 0 && c[2] > 0 && c[3] > 0) || (c[0] < 0 && c[1] < 0 && c[2] < 0 && c[3] < 0)) return false;
    if (c[0] * c[3] <= 0 || halvings == 0) return true;
    const double ab = (c[0] + c[1]) / 2, bc = (c[1] + c[2]) / 2, cd = (c[2] + c[3]) / 2;
    const double abc = (ab + bc) / 2, bcd = (bc + cd) / 2, middle = (abc + bcd) / 2;
    return has_root({c[0], ab, abc, middle}, halvings - 1) || has_root({middle, bcd, cd, c[3]}, halvings - 1);
}

}  // namespace

Instance::Instance(std::shared_ptr<const Hittable> object, const Transform& world_from_object)
    : Instance(std::move(object), world_from_object, world_from_object) {}

Instance::Instance(std::shared_ptr<const Hittable> object, const Transform& at_time0, const Transform& at_time1)
    : object_(std::move(object)),
      world_from_object0_(at_time0),
      world_from_object1_(at_time1),
      moving_(!(at_time0 == at_time1)) {
    require_not_null(object_, "Instance", "the object");
    require_finite(at_time0, "Instance", "the transform");
    require_finite(at_time1, "Instance", "the transform at time 1");
    inverse(at_time0);  // throws if singular
    inverse(at_time1);
    if (moving_ && has_root(determinant_over_time(at_time0, at_time1)))
        throw ArgumentError("Instance: the moving transform is singular at some time of the shutter");
}

Box Instance::bounds() const {
    return instance_bounds(world_from_object0_, world_from_object1_, object_->bounds());
}

std::optional<Hit> Instance::hit(const Ray& ray) const {
    if (!is_usable(ray)) return std::nullopt;
    const Transform m = moving_ ? interpolate(world_from_object0_, world_from_object1_, ray.time) : world_from_object0_;
    const Transform inv = inverse(m);
    std::optional<Hit> hit = object_->hit(to_object_ray(m, inv, ray));
    if (!hit) return std::nullopt;
    const auto to_world = [&](const Normal3& n) { return Normal3(normalize(Vec3(transform_normal(inv, n)))); };
    hit->normal = to_world(hit->normal);
    if (!(hit->shading_normal == Normal3{})) hit->shading_normal = to_world(hit->shading_normal);
    hit->position_error = transformed_error(m, inv, ray.at(hit->t), hit->position_error);
    return hit;
}

void Instance::lower(RecordSink& sink) const {
    const GroupId group = sink.group(object_, [&](RecordSink& inner) { object_->lower(inner); });
    sink.instance({world_from_object0_, world_from_object1_, group, moving_});
}

}  // namespace limn
