#include "query/surface_at.h"

#include "predicates/hit_error.h"
#include "predicates/mesh_triangle.h"

namespace limn::query {

namespace {

void on_foreign(const flat::Foreign& shape, Ray ray, double t, SurfaceHit& out) {
    // Called once more for what traversal did not keep; a pure shape answers as it did then.
    ray.t_max = t;
    ForeignHit foreign;
    out = {};
    if (!shape.hit(*shape.object, ray, foreign)) return;
    Surface& s = out.surface;
    s.position = ray.at(foreign.t);
    s.position_error = ray_error(ray, foreign.t) + foreign.position_error;
    s.normal = foreign.normal;
    s.shading_normal = foreign.shading_normal == Normal3{} ? foreign.normal : foreign.shading_normal;
    s.uv = foreign.uv;
    s.material = foreign.material;
    out.index_matched = foreign.index_matched;
}

// `found`: by the search, which works out u and v too.
void on_primitive(const flat::Scene& scene, const flat::Place& place, const Ray& ray, const PlanarHit& found,
                  bool with_uv, SurfaceHit& out) {
    const PrimitiveRange& range = scene.ranges[place.range];
    if (range.kind == PrimitiveKind::foreign)
        return on_foreign(scene.foreign[range.first_row + place.element], ray, found.t, out);
    flat::with_primitive(scene, range, place.element,
                         [&](const auto& primitive) { primitive.surface(ray, found, with_uv, out.surface); });
    if (range.kind != PrimitiveKind::mesh) return;
    const flat::Mesh& mesh = scene.meshes[range.first_row];
    if (!mesh.places.empty()) return;
    out.surface.shading_normal = shading_normal(mesh.arrays, place.element, found, out.surface.normal);
    out.surface.uv = texture_coordinates(mesh.arrays, place.element, found);
}

// From the space of an instanced group to that around it.
void leave_instance(const flat::Instance& instance, double time, Surface& hit) {
    Transform m_now, inv_now;
    if (instance.moving) {
        m_now = interpolate(instance.world_from_object0, instance.world_from_object1, time);
        inv_now = inverse(m_now);
    }
    const Transform& m = instance.moving ? m_now : instance.world_from_object0;
    const Transform& inv = instance.moving ? inv_now : instance.object_from_world;
    const auto outward = [&](const Normal3& n) { return Normal3(normalize(Vec3(transform_normal(inv, n)))); };
    hit.position = transform_point(m, hit.position);
    hit.position_error = transformed_error(m, inv, hit.position, hit.position_error);
    const bool flat_shaded = hit.shading_normal == hit.normal;
    hit.normal = outward(hit.normal);
    hit.shading_normal = flat_shaded ? hit.normal : outward(hit.shading_normal);
}

// What foreign shapes need to know of a ray, and what is enough for others.
Ray ray_of(const RayFrame& frame) { return frame.with_frame(); }
const Ray& ray_of(const Ray& ray) { return ray; }

template <class Visit>
void step_inside(const flat::Instance& instance, const RayFrame& outside, const Visit& visit) {
    trace::inside(instance, outside, visit);
}
template <class Visit>
void step_inside(const flat::Instance& instance, const Ray& outside, const Visit& visit) {
    if (!instance.moving) return visit(ray_inside(outside, instance.world_from_object0, instance.object_from_world));
    const Transform m = interpolate(instance.world_from_object0, instance.world_from_object1, outside.time);
    visit(ray_inside(outside, m, inverse(m)));
}

// Within `level` and more of the instances around it.
template <class RayOrFrame>
void hit_within(const flat::Scene& scene, const flat::Place& place, std::uint32_t level, const RayOrFrame& outside,
                const PlanarHit& found, bool with_uv, SurfaceHit& out) {
    const Ray& ray = ray_of(outside);
    if (level < place.depth) {
        const flat::Instance& instance = scene.instances[place.instances[level]];
        step_inside(instance, outside,
                    [&](const RayOrFrame& inner) { hit_within(scene, place, level + 1, inner, found, with_uv, out); });
        leave_instance(instance, ray.time, out.surface);
        return;
    }
    on_primitive(scene, place, ray, found, with_uv, out);
    // Whether the ray meets the outward side is asked here, where the normal is not transformed.
    out.surface.front_face = dot(out.surface.normal, ray.direction) < 0;
}

}  // namespace

SurfaceHit surface_at(const flat::Scene& scene, const Ray& ray, const trace::Hit& hit, bool with_uv) {
    SurfaceHit out;
    surface_at(scene, ray, hit, with_uv, out);
    return out;
}

void surface_at(const flat::Scene& scene, const Ray& ray, const trace::Hit& raw, bool with_uv, SurfaceHit& out) {
    const flat::Place place = flat::locate(scene, raw.primitive);
    const PlanarHit found{raw.t, raw.u, raw.v};
    Surface& s = out.surface;
    out.index_matched = false;
    const PrimitiveRange& range = scene.ranges[place.range];
    if (range.kind == PrimitiveKind::foreign) {
        hit_within(scene, place, 0, RayFrame(ray), found, with_uv, out);
    } else {
        hit_within(scene, place, 0, ray, found, with_uv, out);
        s.material = {static_cast<std::uint32_t>(flat::material_of(scene, range, place.element)), nullptr, nullptr};
    }
    out.index_matched = out.index_matched || place.index_matched;
    s.normal = Normal3((s.front_face ? 1.0 : -1.0) * Vec3(s.normal));
    // A mesh may hold normals that disagree with its winding: they go to the same side.
    s.shading_normal = Normal3((dot(s.shading_normal, s.normal) < 0 ? -1.0 : 1.0) * Vec3(s.shading_normal));
}

}  // namespace limn::query
