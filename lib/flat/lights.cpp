#include "flat/lights.h"

#include <cmath>

#include "flat/scene.h"
#include "geometry/hit_error.h"
#include "math/sphere_uv.h"

namespace limn::flat {

namespace {

// Right angles but for rounding.
bool is_rectangle(const Light& light) {
    return std::abs(dot(light.edge_u, light.edge_v)) <= 1e-12 * length(light.edge_u) * length(light.edge_v);
}

// Sets the corner and edges of a planar shape as they are described.
void describe(const Scene& scene, const PrimitiveRange& range, std::uint64_t element, Light& light) {
    with_primitive(scene, range, element, [&]<class Kind>(const Kind& primitive) {
        if constexpr (requires { primitive.patch(); }) {
            const primitives::Patch patch = primitive.patch();
            light.origin = patch.corner, light.edge_u = patch.edge_u, light.edge_v = patch.edge_v;
            light.primitive = Kind::kKind, light.share = Kind::kShare;
            light.kind = Kind::kShare == 1                        ? LightKind::parallelogram
                         : Kind::kKind == PrimitiveKind::triangle ? LightKind::triangle
                                                                  : LightKind::patch;
        }
    });
}

// \param mirrored whether the edges' product is opposite to the outward normal
void finish(const Scene& scene, const PrimitiveRange& range, std::uint64_t element, bool mirrored, Light& light) {
    if (light.kind == LightKind::parallelogram && is_rectangle(light)) light.kind = LightKind::rectangle;
    light.material = material_of(scene, range, element);
    const MaterialRecord& material = scene.materials[static_cast<std::size_t>(light.material)];
    light.textured = !is_plain(scene, material.emission);
    light.side = side_of(material.sides, mirrored);
}

}  // namespace

std::int8_t side_of(Sides sides, bool mirrored) {
    return static_cast<std::int8_t>(sides == Sides::both ? 0 : (sides == Sides::front) != mirrored ? 1 : -1);
}

bool is_plain(const Scene& scene, TextureId texture) {
    return scene.textures[static_cast<std::size_t>(texture)].kind == TextureKind::solid;
}

Box bounds_of(const Light& light) {
    Box box;
    if (light.kind == LightKind::sphere) {
        for (const Point3& c : {light.origin, light.origin + light.edge_u})
            for (const double r : {-light.radius, light.radius}) box.extend(c + along_every_axis(r));
        return box;
    }
    box.extend(light.origin);
    if (light.kind >= LightKind::point) return box;
    box.extend(light.origin + light.edge_u);
    box.extend(light.origin + light.edge_v);
    if (light.kind != LightKind::triangle) box.extend(light.origin + light.edge_u + light.edge_v);
    return box;
}

Uv sample_area(const Light& light, double u, double v) {
    return primitives::value_of_kind(light.primitive, Uv{},
                                     [&]<class Kind>(std::type_identity<Kind>) { return Kind::weights(u, v); });
}

Light planar_light(const Scene& scene, const PrimitiveRange& range, std::uint64_t element, const Transform& m,
                   const Transform& inverse_of_m) {
    Light light;
    describe(scene, range, element, light);
    const Vec3 error = planar_error(light.origin, light.edge_u, light.edge_v);
    light.origin = transform_point(m, light.origin);
    light.edge_u = transform_vector(m, light.edge_u);
    light.edge_v = transform_vector(m, light.edge_v);
    const double reach = max_abs(light.origin) + max_abs(light.edge_u) + max_abs(light.edge_v);
    light.position_error = transformed_error(m, inverse_of_m, Point3{reach, reach, reach}, error);
    finish(scene, range, element, determinant(m) < 0, light);
    return light;
}

const Light& light_at(const Scene& scene, std::size_t rank, double time, Light& room) {
    const LightTable& table = scene.lights;
    if (rank >= table.size()) return table.distant[rank - table.size()].light;
    const LightRef ref = table.refs[rank];
    if (ref.place == LightRef::kOwn) {
        const Light& own = table.own[ref.element];
        if (own.kind != LightKind::sphere || own.edge_u == Vec3{}) return own;
        room = own;
        room.origin = interpolate(own.origin, own.origin + own.edge_u, time);
        room.edge_u = {};
        return room;
    }
    const LightPlace& place = table.places[ref.place];
    const PrimitiveRange& range = scene.ranges[place.range];
    room = {};
    if (place.instance_count > 0) {
        Transform m;
        for (std::uint32_t i = 0; i < place.instance_count; ++i)
            m = m * world_from_object(scene.instances[table.instances[place.first_instance + i]], time);
        room = planar_light(scene, range, ref.element, m, inverse(m));
    } else if (place.transformed) {
        room = planar_light(scene, range, ref.element, place.world_from_object, place.object_from_world);
    } else {
        describe(scene, range, ref.element, room);
        room.position_error = planar_error(room.origin, room.edge_u, room.edge_v);
        finish(scene, range, ref.element, false, room);
    }
    room.number = place.first_number + ref.element;
    return room;
}

}  // namespace limn::flat
