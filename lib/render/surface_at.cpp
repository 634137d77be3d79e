#include "render/surface_at.h"

#include "core/hit_error.h"
#include "core/mesh_triangle.h"
#include "core/plane_normal.h"
#include "core/sheared_ray.h"
#include "core/sphere_uv.h"

namespace limn::tracing {

namespace {

// A hit in the primitive's own space. Normals are outward.
struct LocalHit {
    Point3 position;
    Vec3 position_error;
    Normal3 normal, shading_normal;
    Uv uv;
    MaterialRef material;
    bool index_matched = false;
};

LocalHit on_sphere(const Point3& center, double radius, const Ray& ray, double t, bool with_uv) {
    const Vec3 outward = sphere_normal(center, ray, t);
    LocalHit hit;
    hit.position = center + std::abs(radius) * outward;
    hit.position_error = sphere_error(center, radius);
    hit.normal = hit.shading_normal = Normal3(radius < 0 ? -outward : outward);
    if (with_uv) hit.uv = sphere_uv(Vec3(hit.normal));
    return hit;
}

LocalHit on_plane(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const Normal3& normal,
                  const PlanarHit& planar) {
    LocalHit hit;
    hit.position = corner + (planar.u * edge_u + planar.v * edge_v);
    hit.position_error = planar_error(corner, edge_u, edge_v);
    hit.normal = hit.shading_normal = normal;
    hit.uv = {planar.u, planar.v};
    return hit;
}

LocalHit on_triangle(const TriangleVertices& v, const PlanarHit& planar) {
    return on_plane(v.a, v.b - v.a, v.c - v.a, triangle_normal(v.a, v.b, v.c), planar);
}

LocalHit on_mesh(const flat::Scene& scene, const flat::Mesh& mesh, std::uint64_t element, const PlanarHit& planar) {
    LocalHit hit = on_triangle(triangle_of(scene, mesh, element), planar);
    if (!mesh.places.empty()) return hit;
    if constexpr (flat::kHasSmoothNormals)
        hit.shading_normal = shading_normal(mesh.arrays, element, planar, hit.normal);
    hit.uv = texture_coordinates(mesh.arrays, element, planar);
    return hit;
}

LocalHit on_foreign(const flat::Foreign& shape, const RayFrame& frame, double t) {
    // Called once more for what traversal did not keep; a pure shape answers as it did then.
    const FrameScope scope(frame);
    Ray ray = frame.ray;
    ray.t_max = t;
    ForeignHit foreign;
    LocalHit hit;
    if (!shape.hit(*shape.object, ray, foreign)) return hit;
    hit.position = ray.at(foreign.t);
    hit.position_error = ray_error(ray, foreign.t) + foreign.position_error;
    hit.normal = foreign.normal;
    hit.shading_normal = foreign.shading_normal == Normal3{} ? foreign.normal : foreign.shading_normal;
    hit.uv = foreign.uv;
    hit.material = foreign.material;
    hit.index_matched = foreign.index_matched;
    return hit;
}

// `found`: by the search, which works out u and v too. `frame`: what the ray stands for, if it is inside an instance.
LocalHit on_primitive(const flat::Scene& scene, const flat::Place& place, const Ray& ray, const RayFrame* frame,
                      const PlanarHit& found, bool with_uv) {
    const PrimitiveRange& range = scene.ranges[place.range];
    const std::size_t row = range.first_row + place.element;
    switch (range.kind) {
        case PrimitiveKind::sphere: {
            const flat::Sphere& s = scene.spheres[row];
            return on_sphere(s.center, s.radius, ray, found.t, with_uv);
        }
        case PrimitiveKind::moving_sphere: {
            const flat::MovingSphere& s = scene.moving_spheres[row];
            return on_sphere(interpolate(s.center0, s.center1, ray.time), s.radius, ray, found.t, with_uv);
        }
        case PrimitiveKind::triangle: {
            const flat::Triangle& triangle = scene.triangles[row];
            return on_triangle({triangle.a, triangle.b, triangle.c}, found);
        }
        case PrimitiveKind::quad: {
            const flat::Quad& q = scene.quads[row];
            return on_plane(q.corner, q.edge_u, q.edge_v, scene.quad_normals[row], found);
        }
        case PrimitiveKind::mesh: return on_mesh(scene, scene.meshes[range.first_row], place.element, found);
        case PrimitiveKind::foreign:
            if constexpr (flat::kHasForeignShapes)
                return on_foreign(scene.foreign[row], frame ? *frame : RayFrame(ray), found.t);
            break;
        case PrimitiveKind::instance:
        case PrimitiveKind::medium: break;  // locate() goes through them
    }
    return {};
}

// From the space of an instanced group to that around it.
void leave_instance(const flat::Instance& instance, double time, LocalHit& hit) {
    const bool moving = flat::kHasMotion && instance.moving;
    const Transform m = moving ? interpolate(instance.world_from_object0, instance.world_from_object1, time)
                               : instance.world_from_object0;
    const Transform inv = moving ? inverse(m) : instance.object_from_world;
    const auto outward = [&](const Normal3& n) { return Normal3(normalize(Vec3(transform_normal(inv, n)))); };
    hit.position = transform_point(m, hit.position);
    hit.position_error = transformed_error(m, inv, hit.position, hit.position_error);
    const bool flat_shaded = hit.shading_normal == hit.normal;
    hit.normal = outward(hit.normal);
    hit.shading_normal = flat_shaded ? hit.normal : outward(hit.shading_normal);
}

// `front`: whether the ray meets the outward side; asked here, where the normal is not transformed.
LocalHit hit_at(const flat::Scene& scene, const flat::Place& place, const Ray& ray, const RayFrame* frame,
                const PlanarHit& found, bool with_uv, bool& front) {
    const LocalHit hit = on_primitive(scene, place, ray, frame, found, with_uv);
    front = dot(hit.normal, ray.direction) < 0;
    return hit;
}

// Within `level` and more of the instances around it.
LocalHit hit_within(const flat::Scene& scene, const flat::Place& place, std::uint32_t level, const RayFrame& frame,
                    const PlanarHit& found, bool with_uv, bool& front) {
    if (level == place.depth) return hit_at(scene, place, frame.ray, &frame, found, with_uv, front);
    const flat::Instance& instance = scene.instances[place.instances[level]];
    LocalHit hit = kernels::inside(instance, frame, [&](const RayFrame& inner) {
        return hit_within(scene, place, level + 1, inner, found, with_uv, front);
    });
    leave_instance(instance, frame.ray.time, hit);
    return hit;
}

}  // namespace

SurfaceHit surface_at(const flat::Scene& scene, const Ray& ray, const kernels::Hit& raw, bool with_uv) {
    const flat::Place place = flat::locate(scene, raw.primitive);
    bool front = true;
    const PlanarHit found{raw.t, raw.u, raw.v};
    LocalHit hit = flat::kHasInstances && place.depth > 0
                       ? hit_within(scene, place, 0, RayFrame(ray), found, with_uv, front)
                       : hit_at(scene, place, ray, nullptr, found, with_uv, front);
    const PrimitiveRange& range = scene.ranges[place.range];
    if (range.kind != PrimitiveKind::foreign)
        hit.material.id = static_cast<std::uint32_t>(flat::material_of(scene, range, place.element));

    SurfaceHit out;
    out.index_matched = place.index_matched || hit.index_matched;
    Surface& s = out.surface;
    s.position = hit.position;
    s.position_error = hit.position_error;
    s.front_face = front;
    s.normal = front ? hit.normal : -hit.normal;
    // A mesh may hold normals that disagree with its winding: they go to the same side.
    s.shading_normal = dot(hit.shading_normal, s.normal) < 0 ? -hit.shading_normal : hit.shading_normal;
    s.uv = hit.uv;
    s.material = hit.material;
    return out;
}

}  // namespace limn::tracing
