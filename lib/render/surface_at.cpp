#include "render/surface_at.h"

#include "core/sphere_uv.h"
#include "predicates/hit_error.h"
#include "predicates/mesh_triangle.h"
#include "predicates/plane_normal.h"

namespace limn::tracing {

namespace {

// While it is in the primitive's own space, the normals of a surface are outward. It is filled in place: a copy would
// wait for what was just written.

void on_sphere(const Point3& center, double radius, const Ray& ray, double t, bool with_uv, Surface& s) {
    const Vec3 outward = sphere_normal(center, ray, t);
    s.position = center + std::abs(radius) * outward;
    s.position_error = sphere_error(center, radius);
    const Vec3 n = (radius < 0 ? -1.0 : 1.0) * outward;
    s.normal = {n.x, n.y, n.z};
    s.shading_normal = {n.x, n.y, n.z};
    if (with_uv) s.uv = sphere_uv(Vec3(s.normal));
}

void on_plane(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const Normal3& normal,
              const PlanarHit& planar, Surface& s) {
    s.position = corner + (planar.u * edge_u + planar.v * edge_v);
    s.position_error = planar_error(corner, edge_u, edge_v);
    s.normal = s.shading_normal = normal;
    s.uv = {planar.u, planar.v};
}

void on_triangle(const TriangleVertices& v, const PlanarHit& planar, Surface& s) {
    on_plane(v.a, v.b - v.a, v.c - v.a, triangle_normal(v.a, v.b, v.c), planar, s);
}

void on_mesh(const flat::Scene& scene, const flat::Mesh& mesh, std::uint64_t element, const PlanarHit& planar,
             Surface& s) {
    on_triangle(triangle_of(scene, mesh, element), planar, s);
    if (!mesh.places.empty()) return;
    s.shading_normal = shading_normal(mesh.arrays, element, planar, s.normal);
    s.uv = texture_coordinates(mesh.arrays, element, planar);
}

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
    Surface& surface = out.surface;
    const PrimitiveRange& range = scene.ranges[place.range];
    const std::size_t row = range.first_row + place.element;
    switch (range.kind) {
        case PrimitiveKind::sphere: {
            const flat::Sphere& s = scene.spheres[row];
            return on_sphere(s.center, s.radius, ray, found.t, with_uv, surface);
        }
        case PrimitiveKind::moving_sphere: {
            const flat::MovingSphere& s = scene.moving_spheres[row];
            return on_sphere(interpolate(s.center0, s.center1, ray.time), s.radius, ray, found.t, with_uv, surface);
        }
        case PrimitiveKind::triangle: {
            const flat::Triangle& triangle = scene.triangles[row];
            return on_triangle({triangle.a, triangle.b, triangle.c}, found, surface);
        }
        case PrimitiveKind::quad: {
            const flat::Quad& q = scene.quads[row];
            return on_plane(q.corner, q.edge_u, q.edge_v, scene.quad_normals[row], found, surface);
        }
        case PrimitiveKind::mesh: return on_mesh(scene, scene.meshes[range.first_row], place.element, found, surface);
        case PrimitiveKind::foreign: return on_foreign(scene.foreign[row], ray, found.t, out);
        case PrimitiveKind::instance:
        case PrimitiveKind::medium: break;  // locate() goes through them
    }
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
    kernels::inside(instance, outside, visit);
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

SurfaceHit surface_at(const flat::Scene& scene, const Ray& ray, const kernels::Hit& hit, bool with_uv) {
    SurfaceHit out;
    surface_at(scene, ray, hit, with_uv, out);
    return out;
}

void surface_at(const flat::Scene& scene, const Ray& ray, const kernels::Hit& raw, bool with_uv, SurfaceHit& out) {
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

}  // namespace limn::tracing
