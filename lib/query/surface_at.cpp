#include "query/surface_at.h"

#include "geometry/hit_error.h"
#include "geometry/mesh_triangle.h"

namespace limn::query {

namespace {

// Sets `out` to the surface of a user-defined shape that is hit at t.
void on_user_defined(const flat::UserDefined& shape, Ray ray, double t, SurfaceHit& out) {
    // Call the shape's hit function again, because traversal did not keep the rest of its result. A function without
    // side effects returns the same hit.
    ray.t_max = t;
    UserDefinedHit hit;
    out = {};
    if (!shape.hit(*shape.object, ray, hit)) return;
    Surface& s = out.surface;
    s.position = ray.at(hit.t);
    s.position_error = ray_error(ray, hit.t) + hit.position_error;
    s.normal = hit.normal;
    s.shading_normal = hit.shading_normal == Normal3{} ? hit.normal : hit.shading_normal;
    s.uv = hit.uv;
    s.material = hit.material;
    out.index_matched = hit.index_matched;
}

// Sets the tangents at a hit. Those of a flat primitive are its edges, because u and v are the weights of the edges.
template <class Primitive>
void set_tangents(const Primitive& primitive, Surface& s) {
    if constexpr (requires { primitive.patch(); }) {
        const primitives::Patch patch = primitive.patch();
        s.dp_du = patch.edge_u;
        s.dp_dv = patch.edge_v;
    } else {
        primitive.tangents(s);
    }
}

// Replaces the tangents of a mesh triangle, which are its edges, by the derivatives of the position by the texture
// coordinates. Keeps the edges if the mesh has no texture coordinates, or if those of the triangle span no area.
void set_mesh_tangents(const MeshView& mesh, std::size_t element, Surface& s) {
    if (mesh.uvs.empty()) return;
    const Index3 t = mesh.triangles[element];
    const Float2 a = mesh.uvs[t.a], b = mesh.uvs[t.b], c = mesh.uvs[t.c];
    const double u1 = double{b.u} - a.u, v1 = double{b.v} - a.v, u2 = double{c.u} - a.u, v2 = double{c.v} - a.v;
    const double area = u1 * v2 - u2 * v1;
    if (area == 0) return;
    const Vec3 along_b = s.dp_du, along_c = s.dp_dv;
    s.dp_du = (v2 * along_b - v1 * along_c) / area;
    s.dp_dv = (u1 * along_c - u2 * along_b) / area;
}

// Sets `out` to the surface at a hit of a primitive, in the space of the primitive's BLAS. `found` holds the t, u and v
// that traversal has found.
void on_primitive(const flat::Scene& scene, const flat::Place& place, const Ray& ray, const PlanarHit& found,
                  Parts parts, SurfaceHit& out) {
    const PrimitiveRange& range = scene.ranges[place.range];
    if (range.kind == PrimitiveKind::user_defined)
        return on_user_defined(scene.user_defined[range.first_row + place.element], ray, found.t, out);
    flat::with_primitive(scene, range, place.element, [&](const auto& primitive) {
        primitive.surface(ray, found, parts.uv, out.surface);
        if (parts.tangents) set_tangents(primitive, out.surface);
    });
    if (range.kind != PrimitiveKind::mesh) return;
    const flat::Mesh& mesh = scene.meshes[range.first_row];
    if (!mesh.places.empty()) return;
    out.surface.shading_normal = shading_normal(mesh.arrays, place.element, found, out.surface.normal);
    out.surface.uv = texture_coordinates(mesh.arrays, place.element, found);
    if (parts.tangents) set_mesh_tangents(mesh.arrays, place.element, out.surface);
}

// Transforms a surface from the space of an instanced BLAS to the space around the instance.
void leave_instance(const flat::Instance& instance, double time, Parts parts, Surface& hit) {
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
    if (parts.tangents) {
        hit.dp_du = transform_vector(m, hit.dp_du);
        hit.dp_dv = transform_vector(m, hit.dp_dv);
    }
}

// Returns the ray that a primitive is given. The ray of a user-defined shape points to its frame, which holds the
// rounding errors; all other primitives need only the ray.
Ray ray_of(const RayFrame& frame) { return frame.with_frame(); }
const Ray& ray_of(const Ray& ray) { return ray; }

// Calls visit() with the ray, or its frame, transformed into the space of the instance's BLAS.
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

// Sets `out` to the surface at a hit, in the space inside the `level` outermost of the instances around the primitive.
// `outside` is the ray in that space. Recurses through the remaining instances.
template <class RayOrFrame>
void hit_within(const flat::Scene& scene, const flat::Place& place, std::uint32_t level, const RayOrFrame& outside,
                const PlanarHit& found, Parts parts, SurfaceHit& out) {
    const Ray& ray = ray_of(outside);
    if (level < place.depth) {
        const flat::Instance& instance = scene.instances[place.instances[level]];
        step_inside(instance, outside,
                    [&](const RayOrFrame& inner) { hit_within(scene, place, level + 1, inner, found, parts, out); });
        leave_instance(instance, ray.time, parts, out.surface);
        return;
    }
    on_primitive(scene, place, ray, found, parts, out);
    // Decide the side here, before transformations add rounding errors to the normal.
    out.surface.front_face = dot(out.surface.normal, ray.direction) < 0;
}

}  // namespace

SurfaceHit surface_at(const flat::Scene& scene, const Ray& ray, const trace::Hit& hit, Parts parts) {
    SurfaceHit out;
    surface_at(scene, ray, hit, parts, out);
    return out;
}

void surface_at(const flat::Scene& scene, const Ray& ray, const trace::Hit& raw, Parts parts, SurfaceHit& out) {
    const flat::Place place = flat::locate(scene, raw.primitive);
    const PlanarHit found{raw.t, raw.u, raw.v};
    Surface& s = out.surface;
    out.index_matched = false;
    const PrimitiveRange& range = scene.ranges[place.range];
    if (range.kind == PrimitiveKind::user_defined) {
        hit_within(scene, place, 0, RayFrame(ray), found, parts, out);
    } else {
        hit_within(scene, place, 0, ray, found, parts, out);
        s.material = {static_cast<std::uint32_t>(flat::material_of(scene, range, place.element)), nullptr, nullptr};
    }
    out.index_matched = out.index_matched || place.index_matched;
    s.normal = Normal3((s.front_face ? 1.0 : -1.0) * Vec3(s.normal));
    // Flip a shading normal that is on the other side: the normals of a mesh may disagree with its winding.
    s.shading_normal = Normal3((dot(s.shading_normal, s.normal) < 0 ? -1.0 : 1.0) * Vec3(s.shading_normal));
}

}  // namespace limn::query
