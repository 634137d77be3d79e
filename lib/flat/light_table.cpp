#include "flat/light_table.h"

#include <cmath>

#include "flat/scene.h"
#include "geometry/hit_error.h"

namespace limn::flat {

namespace {

// Returns true if the edges are perpendicular, except for rounding.
bool is_rectangle(const PlanarLight& light) {
    return std::abs(dot(light.edge_u, light.edge_v)) <= 1e-12 * length(light.edge_u) * length(light.edge_v);
}

// Sets the shape, corner and edges of a light to those of a primitive, as it is described. Leaves them if the primitive
// isn't planar.
void set_shape(const Scene& scene, const PrimitiveRange& range, std::uint64_t element, PlanarLight& light) {
    with_primitive(scene, range, element, [&]<class Kind>(const Kind& primitive) {
        if constexpr (requires { primitive.patch(); }) {
            const primitives::Patch patch = primitive.patch();
            light.corner = patch.corner;
            light.edge_u = patch.edge_u;
            light.edge_v = patch.edge_v;
            light.primitive = Kind::kKind;
            light.share = Kind::kShare;
            light.shape = Kind::kShare == 1                        ? PlanarShape::parallelogram
                          : Kind::kKind == PrimitiveKind::triangle ? PlanarShape::triangle
                                                                   : PlanarShape::part;
        }
    });
}

// Sets the fields that depend on the edges and the material.
//
// \param mirrored true if cross(edge_u, edge_v) is opposite to the outward normal
void finish(const Scene& scene, const PrimitiveRange& range, std::uint64_t element, bool mirrored, PlanarLight& light) {
    if (light.shape == PlanarShape::parallelogram && is_rectangle(light)) light.shape = PlanarShape::rectangle;
    light.material = material_of(scene, range, element);
    const MaterialRecord& material = scene.materials[static_cast<std::size_t>(light.material)];
    light.textured = !is_plain(scene, material.emission);
    light.side = side_of(material.sides, mirrored);
}

// Computes a light of a place at a time. It isn't inlined, so that light_at() does not save the registers that it
// needs.
[[gnu::noinline]] void compute(const Scene& scene, const LightPlace& place, std::uint32_t element, double time,
                               PlanarLight& light) {
    const PrimitiveRange& range = scene.ranges[place.range];
    if (place.instance_count > 0) {
        Transform m;
        for (std::uint32_t i = 0; i < place.instance_count; ++i)
            m = m * world_from_object(scene.instances[scene.lights.instances[place.first_instance + i]], time);
        light = planar_light(scene, range, element, m, inverse(m));
    } else if (place.transformed) {
        light = planar_light(scene, range, element, place.world_from_object, place.object_from_world);
    } else {
        set_shape(scene, range, element, light);
        light.position_error = planar_error(light.corner, light.edge_u, light.edge_v);
        finish(scene, range, element, false, light);
    }
    light.number = place.first_number + element;
}

}  // namespace

std::int8_t side_of(Sides sides, bool mirrored) {
    return static_cast<std::int8_t>(sides == Sides::both ? 0 : (sides == Sides::front) != mirrored ? 1 : -1);
}

bool is_plain(const Scene& scene, TextureId texture) {
    return scene.textures[static_cast<std::size_t>(texture)].kind == TextureKind::solid;
}

PlanarLight planar_light(const Scene& scene, const PrimitiveRange& range, std::uint64_t element, const Transform& m,
                         const Transform& inverse_of_m) {
    PlanarLight light;
    set_shape(scene, range, element, light);
    const Vec3 error = planar_error(light.corner, light.edge_u, light.edge_v);
    light.corner = transform_point(m, light.corner);
    light.edge_u = transform_vector(m, light.edge_u);
    light.edge_v = transform_vector(m, light.edge_v);
    const double reach = max_abs(light.corner) + max_abs(light.edge_u) + max_abs(light.edge_v);
    light.position_error = transformed_error(m, inverse_of_m, Point3{reach, reach, reach}, error);
    finish(scene, range, element, determinant(m) < 0, light);
    return light;
}

const Light& light_at(const Scene& scene, std::size_t rank, double time, Light& room) {
    const LightTable& table = scene.lights;
    if (rank >= table.size()) return table.distant[rank - table.size()].light;
    const LightRef ref = table.refs[rank];
    if (ref.place != LightRef::kOwn) {
        compute(scene, table.places[ref.place], ref.element, time, room.emplace<PlanarLight>());
        return room;
    }
    const Light& own = table.own[ref.element];
    const auto* const sphere = std::get_if<SphereLight>(&own);
    if (!sphere || sphere->motion == Vec3{}) return own;
    auto& moved = room.emplace<SphereLight>(*sphere);
    moved.center = interpolate(sphere->center, sphere->center + sphere->motion, time);
    moved.motion = {};
    return room;
}

}  // namespace limn::flat
