#include "shading/shading.h"

#include <algorithm>

#include "bsdf/bent_normal.h"
#include "bsdf/checker.h"
#include "bsdf/environment.h"
#include "bsdf/image_lookup.h"
#include "bsdf/perlin.h"
#include "math/sphere_uv.h"

namespace limn::shade {

namespace {

// Where the material is on a user-defined shape, or none.
const MaterialRecord kOfObject{.kind = kUserDefinedMaterial, .lobe = &bsdf::kUserDefined};
const MaterialRecord kNone{};

const MaterialRecord& record_of(const flat::Scene& scene, const MaterialRef& material) {
    if (material.id == MaterialRef::kObject) return kOfObject;
    return material.id == MaterialRef::kNone ? kNone : scene.materials[material.id];
}

bool has_normal_map(const MaterialRecord& m) { return m.details && m.details->normal_map != TextureId::none; }

// What to call of a user-defined material: on a user-defined shape, or in the table.
bsdf::UserDefined user_defined(const flat::Scene& scene, const Surface& s) {
    if (s.material.id == MaterialRef::kObject) return {s, s.material.object, s.material.thunks};
    const MaterialRecord& m = scene.materials[s.material.id];
    return {s, m.object, m.thunks};
}

void set_details(const flat::Scene& scene, const MaterialDetails& details, const Surface& s, bsdf::Vertices& v,
                 std::size_t i) {
    v.dp_du.set(i, s.dp_du);
    if (details.texture != TextureId::none)
        v.second_texture.set(i, texture_value(scene, details.texture, s));
    else
        v.second_texture.set(i, Color{1, 1, 1});
    for (std::size_t k = 0; k < MaterialDetails::kNumbers; ++k) v.details[k][i] = details.numbers[k];
    v.albedo_table[i] = details.albedo_table.get();
    v.coat_albedo_table[i] = details.coat_albedo_table.get();
}

// The square makes the edge soft: KHR_lights_punctual, section "Inner and outer cone angles".
double spot_factor(const LightRecord& spot, const Vec3& from_receiver) {
    const double cosine = -dot(from_receiver, spot.direction);
    if (cosine >= spot.cos_inner) return 1;
    const double part = std::max(0.0, (cosine - spot.cos_outer) / (spot.cos_inner - spot.cos_outer));
    return part * part;
}

// Of lights without extent as if they filled kNoSolidAngle, as seen from a distance of 1: points are drawn the more
// densely per solid angle the farther they are.
Color radiance_of_source(const flat::Scene& scene, const lights::LightSamples& samples, std::size_t i) {
    const flat::Light& light = *samples.light[i];
    const flat::Environment& map = scene.environment;
    if (light.kind == flat::LightKind::environment)
        return pattern::map_radiance(*map.image, map.scale, {samples.u[i], samples.v[i]});
    const LightRecord& source = scene.light_sources[light.number];
    if (light.kind == flat::LightKind::sun) return sun_radiance(source);
    const Color irradiance = source.color / flat::kNoSolidAngle;
    if (light.kind != flat::LightKind::spot) return irradiance;
    return spot_factor(source, samples.direction.get<Vec3>(i)) * irradiance;
}

void set_plain_vertex(const flat::Scene& scene, const MaterialRecord& m, const Surface& s, const Vec3& incoming,
                      bsdf::Vertices& v, std::size_t i) {
    v.position.set(i, s.position), v.position_error.set(i, s.position_error);
    v.normal.set(i, s.normal), v.shading_normal.set(i, s.shading_normal);
    v.incoming.set(i, incoming);
    if (m.lobe == &bsdf::kUserDefined) {
        v.user_defined.resize(bsdf::kShaded);
        v.user_defined[i] = user_defined(scene, s);
        return;
    }
    v.albedo.set(i, m.texture == TextureId::none ? Color{1, 1, 1} : texture_value(scene, m.texture, s));
    v.front_face[i] = s.front_face ? 1 : 0;
    v.parameter[i] = m.parameter, v.exact_fresnel[i] = m.fresnel == Fresnel::exact ? 1 : 0;
    if (m.details) set_details(scene, *m.details, s, v, i);
}

}  // namespace

Color texture_value(const flat::Scene& scene, TextureId id, const Surface& s) {
    const TextureRecord& t = scene.textures[static_cast<std::size_t>(id)];
    switch (t.kind) {
        case TextureKind::solid: return t.color;
        case TextureKind::checker:
            return texture_value(scene, pattern::checker_is_even(s.position, t.scale) ? t.even : t.odd, s);
        case TextureKind::image: return pattern::lookup_image(*scene.images[t.data], s.uv, t.filter, t.wrap);
        case TextureKind::noise: return t.color * pattern::noise_factor(*scene.lattices[t.data], t.scale, s.position);
        case TextureKind::turbulence:
            return t.color * pattern::turbulence_factor(*scene.lattices[t.data], t.scale, s.position);
        case TextureKind::marble: return t.color * pattern::marble(*scene.lattices[t.data], t.scale, s.position);
        case TextureKind::user_defined: return t.value(*t.object, s);
    }
    return {};
}

const bsdf::Lobe* lobe_of(const flat::Scene& scene, const MaterialRef& material) {
    return record_of(scene, material).lobe;
}

bool is_specular(const flat::Scene& scene, const MaterialRef& material) { return record_of(scene, material).specular; }

bool can_emit(const flat::Scene& scene, const MaterialRef& material) {
    const MaterialRecord& m = record_of(scene, material);
    return m.emission != TextureId::none || m.lobe == &bsdf::kUserDefined;
}

Color emitted(const flat::Scene& scene, const Surface& s) {
    const MaterialRecord& m = record_of(scene, s.material);
    if (m.emission != TextureId::none)
        return shines(m.sides, s.front_face) ? texture_value(scene, m.emission, s) : Color{};
    if (m.lobe != &bsdf::kUserDefined) return {};
    const bsdf::UserDefined u = user_defined(scene, s);
    return u.thunks->emitted(*u.object, s);
}

Uv texture_coordinates_of(const flat::Scene& scene, const lights::LightSamples& samples, std::size_t i) {
    const flat::Light& light = *samples.light[i];
    if (light.kind == flat::LightKind::sphere)
        return sphere_uv((samples.position.get<Point3>(i) - light.origin) / light.radius);
    const flat::Place place = flat::locate(scene, light.number);
    const PrimitiveRange& range = scene.ranges[place.range];
    if (range.kind != PrimitiveKind::mesh) return {samples.u[i], samples.v[i]};
    return texture_coordinates(scene.meshes[range.first_row].arrays, place.element, {0, samples.u[i], samples.v[i]});
}

Color environment_radiance(const flat::Scene& scene, const Vec3& direction) {
    const flat::Environment& map = scene.environment;
    return pattern::map_radiance(*map.image, map.scale, pattern::map_uv(map.axes, direction));
}

// A disc of radius r and radiance L gives a plane across it pi L sin^2 r.
Color sun_radiance(const LightRecord& sun) { return sun.color / (kPi * sun.one_minus_cos * (2 - sun.one_minus_cos)); }

bool sun_covers(const LightRecord& sun, const Vec3& direction) {
    return length_squared(normalize(direction) + sun.direction) / 2 <= sun.one_minus_cos;  // of unit vectors: 1 - cos
}

Color radiance_of(const flat::Scene& scene, const lights::LightSamples& samples, std::size_t i) {
    const flat::Light& light = *samples.light[i];
    if (light.kind >= flat::LightKind::point) return radiance_of_source(scene, samples, i);
    const TextureId emission = scene.materials[static_cast<std::size_t>(light.material)].emission;
    if (!light.textured && !flat::has_holes(scene.materials[static_cast<std::size_t>(light.material)]))
        return scene.textures[static_cast<std::size_t>(emission)].color;
    Surface s;
    s.position = samples.position.get<Point3>(i), s.position_error = samples.position_error.get<Vec3>(i);
    s.normal = s.shading_normal = samples.normal.get<Normal3>(i);
    s.uv = texture_coordinates_of(scene, samples, i);
    s.material.id = static_cast<std::uint32_t>(light.material);
    return opacity(scene, s) * texture_value(scene, emission, s);
}

double opacity(const flat::Scene& scene, const Surface& s) {
    const MaterialRecord& material = record_of(scene, s.material);
    if (!flat::has_holes(material)) return 1;
    const double opacity = texture_value(scene, material.details->opacity, s).r,
                 cutoff = material.details->opacity_cutoff;
    if (cutoff > 0) return opacity >= cutoff ? 1 : 0;
    return opacity > 0 ? std::min(opacity, 1.0) : 0;
}

Normal3 shading_normal(const flat::Scene& scene, const Surface& s, const Vec3& incoming) {
    const MaterialRecord& m = record_of(scene, s.material);
    if (!has_normal_map(m)) return s.shading_normal;
    return bsdf::bent_normal(s, -normalize(incoming), texture_value(scene, m.details->normal_map, s));
}

void set_vertex(const flat::Scene& scene, const Surface& s, const Vec3& incoming, bsdf::Vertices& v, std::size_t i) {
    const MaterialRecord& m = record_of(scene, s.material);
    if (!has_normal_map(m)) return set_plain_vertex(scene, m, s, incoming, v, i);
    if (m.lobe->one_sided) v.folds |= std::uint32_t{1} << i;
    Surface bent = s;
    bent.shading_normal = shading_normal(scene, s, incoming);
    set_plain_vertex(scene, m, bent, incoming, v, i);
}

}  // namespace limn::shade
