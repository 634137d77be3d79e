#include "shade/shading.h"

#include "core/sphere_uv.h"
#include "pattern/checker.h"
#include "pattern/image_lookup.h"
#include "pattern/perlin.h"

namespace limn::shade {

namespace {

// Where the material is on a user-defined shape, or none.
const MaterialRecord kOfObject{.kind = kUserDefinedMaterial, .lobe = &bsdf::kUserDefined};
const MaterialRecord kNone{};

const MaterialRecord& record_of(const flat::Scene& scene, const MaterialRef& material) {
    if (material.id == MaterialRef::kObject) return kOfObject;
    return material.id == MaterialRef::kNone ? kNone : scene.materials[material.id];
}

// What to call of a user-defined material: on a user-defined shape, or in the table.
bsdf::UserDefined user_defined(const flat::Scene& scene, const Surface& s) {
    if (s.material.id == MaterialRef::kObject) return {s, s.material.object, s.material.thunks};
    const MaterialRecord& m = scene.materials[s.material.id];
    return {s, m.object, m.thunks};
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
        case TextureKind::foreign: return t.value(*t.object, s);
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
    if (m.emission != TextureId::none) return texture_value(scene, m.emission, s);
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

Color radiance_of(const flat::Scene& scene, const lights::LightSamples& samples, std::size_t i) {
    const flat::Light& light = *samples.light[i];
    const TextureId emission = scene.materials[static_cast<std::size_t>(light.material)].emission;
    if (!light.textured) return scene.textures[static_cast<std::size_t>(emission)].color;
    Surface s;
    s.position = samples.position.get<Point3>(i), s.position_error = samples.position_error.get<Vec3>(i);
    s.normal = s.shading_normal = samples.normal.get<Normal3>(i);
    s.uv = texture_coordinates_of(scene, samples, i);
    s.material.id = static_cast<std::uint32_t>(light.material);
    return texture_value(scene, emission, s);
}

void set_vertex(const flat::Scene& scene, const Surface& s, const Vec3& incoming, bsdf::Vertices& v, std::size_t i) {
    v.position.set(i, s.position), v.position_error.set(i, s.position_error);
    v.normal.set(i, s.normal), v.shading_normal.set(i, s.shading_normal);
    v.incoming.set(i, incoming);
    const MaterialRecord& m = record_of(scene, s.material);
    if (m.lobe == &bsdf::kUserDefined) {
        v.user_defined.resize(bsdf::kShaded);
        v.user_defined[i] = user_defined(scene, s);
        return;
    }
    v.albedo.set(i, m.texture == TextureId::none ? Color{1, 1, 1} : texture_value(scene, m.texture, s));
    v.front_face[i] = s.front_face ? 1 : 0;
    v.parameter[i] = m.parameter, v.exact_fresnel[i] = m.fresnel == Fresnel::exact ? 1 : 0;
}

}  // namespace limn::shade
