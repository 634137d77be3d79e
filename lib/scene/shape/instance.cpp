#include "limn/scene/shape/instance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/bounds.h"
#include "geometry/ray_frame.h"
#include "math/float_environment.h"
#include "math/scaled_matrix.h"
#include "scene/shape/arguments.h"

namespace limn {

namespace {

using Cubic = std::array<double, 4>;

// Returns the Bernstein coefficients of the determinant of (1-t) A + t B, a cubic in t. A determinant is linear in each
// row, so the coefficients are means of determinants with some rows from A and some from B. A and B are scaled first,
// so that products neither overflow nor underflow. The scale moves a root within [0, 1], but not out of it.
Cubic determinant_over_time(const Transform& at_time0, const Transform& at_time1) {
    const Transform a = ScaledMatrix(at_time0).matrix, b = ScaledMatrix(at_time1).matrix;
    const auto mixed = [&](bool row0, bool row1, bool row2) {
        return determinant(
            {{row0 ? b.rows[0] : a.rows[0], row1 ? b.rows[1] : a.rows[1], row2 ? b.rows[2] : a.rows[2]}});
    };
    return {mixed(0, 0, 0), (mixed(1, 0, 0) + mixed(0, 1, 0) + mixed(0, 0, 1)) / 3,
            (mixed(0, 1, 1) + mixed(1, 0, 1) + mixed(1, 1, 0)) / 3, mixed(1, 1, 1)};
}

// Returns true if the cubic with these Bernstein coefficients has a root in [0, 1], or comes so close to 0 that this
// can't be decided. `rounding` bounds the error of the coefficients.
//
// A polynomial is within the convex hull of its coefficients. It has no root if all of them are above `rounding`, or
// all below -rounding. It has one if its values at the ends differ in sign. Otherwise the interval is halved by de
// Casteljau's algorithm. A cubic that is undecided after 20 halvings touches 0 or comes within 1e-12 of it.
bool has_root(const Cubic& c, double rounding = 0, int halvings = 20) {
    const auto [least, most] = std::minmax_element(c.begin(), c.end());
    if (*least > rounding || *most < -rounding) return false;
    if (c[0] == 0 || c[3] == 0 || (c[0] > 0) != (c[3] > 0) || halvings == 0) return true;
    const double ab = (c[0] + c[1]) / 2, bc = (c[1] + c[2]) / 2, cd = (c[2] + c[3]) / 2;
    const double abc = (ab + bc) / 2, bcd = (bc + cd) / 2, middle = (abc + bcd) / 2;
    const double rounded = std::max(rounding, 1e-14 * std::max(std::abs(*least), std::abs(*most)));
    return has_root({c[0], ab, abc, middle}, rounded, halvings - 1) ||
           has_root({middle, bcd, cd, c[3]}, rounded, halvings - 1);
}

}  // namespace

void require_placement(const Transform& at_time0, const Transform& at_time1, std::string_view who) {
    require_finite(at_time0, who, "the transform");
    require_finite(at_time1, who, "the transform at time 1");
    const FloatEnvironment environment;
    const auto require_inverse = [&](const Transform& m) {
        if (is_singular(m)) throw ArgumentError(std::string(who) + ": the matrix is singular");
        inverse(m);  // throws if the inverse overflows
    };
    require_inverse(at_time0);
    if (at_time0 == at_time1) return;
    require_inverse(at_time1);
    if (has_root(determinant_over_time(at_time0, at_time1)))
        throw ArgumentError(std::string(who) + ": the moving transform is singular at some time of the shutter");
}

Instance::Instance(std::shared_ptr<const Hittable> object, const Transform& world_from_object)
    : Instance(std::move(object), world_from_object, world_from_object) {}

Instance::Instance(std::shared_ptr<const Hittable> object, const Transform& at_time0, const Transform& at_time1)
    : object_(std::move(object)),
      world_from_object0_(at_time0),
      world_from_object1_(at_time1),
      moving_(!(at_time0 == at_time1)) {
    require_not_null(object_, "Instance", "the object");
    require_placement(at_time0, at_time1, "Instance");
}

Box Instance::box() const { return instance_bounds(world_from_object0_, world_from_object1_, object_->bounds()); }

std::optional<Hit> Instance::intersect(const Ray& ray) const {
    const Transform m = moving_ ? interpolate(world_from_object0_, world_from_object1_, ray.time) : world_from_object0_;
    const Transform inv = inverse(m);
    const RayFrame outside = frame_of(ray), inside(outside, m, inv, inverse_error(m));
    std::optional<Hit> hit = object_->hit(inside.with_frame());
    if (!hit) return std::nullopt;
    const auto to_world = [&](const Normal3& n) { return Normal3(normalize(Vec3(transform_normal(inv, n)))); };
    hit->normal = to_world(hit->normal);
    if (!(hit->shading_normal == Normal3{})) hit->shading_normal = to_world(hit->shading_normal);
    hit->position_error = transformed_error(m, inv, ray.at(hit->t), hit->position_error);
    return hit;
}

void Instance::lower(RecordSink& sink) const {
    const BlasId blas = sink.blas(object_, [&](RecordSink& inner) { object_->lower(inner); });
    sink.instance({world_from_object0_, world_from_object1_, blas, moving_});
}

}  // namespace limn
