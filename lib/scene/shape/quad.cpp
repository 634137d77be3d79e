#include "limn/scene/shape/quad.h"

#include "geometry/bounds.h"
#include "geometry/intersect.h"
#include "geometry/plane_normal.h"
#include "limn/scene/shape/hittable_list.h"
#include "math/float_environment.h"
#include "scene/shape/arguments.h"

namespace limn {

Quad::Quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, std::shared_ptr<const Material> material)
    : corner_(corner), edge_u_(edge_u), edge_v_(edge_v), material_(std::move(material)) {
    const FloatEnvironment environment;
    require_finite(corner, "Quad", "the corner");
    require_finite(edge_u, "Quad", "edge u");
    require_finite(edge_v, "Quad", "edge v");
    if (are_parallel(edge_u, edge_v)) throw ArgumentError("Quad: the edges must not be zero or parallel");
}

Box Quad::box() const { return quad_bounds(corner_, edge_u_, edge_v_); }

std::optional<Hit> Quad::intersect(const Ray& ray) const {
    PlanarHit hit;
    if (!intersect_quad(corner_, edge_u_, edge_v_, frame_of(ray), {ray.t_min, ray.t_max}, hit)) return std::nullopt;
    return Hit{.t = hit.t,
               .normal = quad_normal(edge_u_, edge_v_),
               .u = hit.u,
               .v = hit.v,
               .material = material_.get(),
               .position_error = planar_error(corner_, edge_u_, edge_v_)};
}

void Quad::lower(RecordSink& sink) const { sink.quad({corner_, edge_u_, edge_v_, lower_material(sink, material_)}); }

std::shared_ptr<HittableList> make_box(const Point3& corner, const Point3& opposite,
                                       const std::shared_ptr<const Material>& material) {
    const FloatEnvironment environment;
    // Compute the edges.
    Box box;
    box.extend(corner);
    box.extend(opposite);
    const Point3 lo = box.lower, hi = box.upper;
    Vec3 d;  // rounded up, so that sides touch or overlap and no ray passes between them
    for (std::size_t a = 0; a < 3; ++a) d[a] = difference_up(hi[a], lo[a]);
    if (!is_finite(d) || !(d.x > 0 && d.y > 0 && d.z > 0)) throw ArgumentError("make_box: the box must not be flat");
    const Vec3 dx{d.x, 0, 0}, dy{0, d.y, 0}, dz{0, 0, d.z};
    // Make the sides, with outward normals: front, right, back, left, top, bottom.
    auto sides = std::make_shared<HittableList>();
    const auto add = [&](const Point3& q, const Vec3& u, const Vec3& v) {
        sides->add(std::make_shared<Quad>(q, u, v, material));
    };
    add({lo.x, lo.y, hi.z}, dx, dy);
    add({hi.x, lo.y, hi.z}, -dz, dy);
    add({hi.x, lo.y, lo.z}, -dx, dy);
    add({lo.x, lo.y, lo.z}, dz, dy);
    add({lo.x, hi.y, hi.z}, dx, -dz);
    add({lo.x, lo.y, lo.z}, dx, dz);
    return sides;
}

}  // namespace limn
