#include "shading/shading.h"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "bsdf/bent_normal.h"
#include "bsdf/checker.h"
#include "bsdf/image_lookup.h"
#include "bsdf/perlin.h"
#include "math/sphere_uv.h"

namespace limn::shade {

namespace {

// The records of a material on a user-defined shape, which is called through MaterialRef, and of no material.
const MaterialRecord kOfObject{.kind = kUserDefinedMaterial, .lobe = &bsdf::kUserDefined};
const MaterialRecord kNone{};

const MaterialRecord& record_of(const flat::Scene& scene, const MaterialRef& material) {
    if (material.id == MaterialRef::kObject) return kOfObject;
    return material.id == MaterialRef::kNone ? kNone : scene.materials[material.id];
}

bool has_normal_map(const MaterialRecord& m) { return m.normal_map != TextureId::none; }

// Returns how the user-defined material of a surface is called. It is on a user-defined shape, or in the table.
bsdf::UserDefined user_defined(const flat::Scene& scene, const Surface& s) {
    if (s.material.id == MaterialRef::kObject) return {s, s.material.object, s.material.thunks};
    const MaterialRecord& m = scene.materials[s.material.id];
    return {s, m.object, m.thunks};
}

Color value_or_white(const flat::Scene& scene, TextureId id, const Surface& s) {
    return id == TextureId::none ? Color{1, 1, 1} : texture_value(scene, id, s);
}

// Returns the radiance of a sample of a surface.
Color surface_radiance(const flat::Scene& scene, const flat::SurfaceLight& light, const lights::LightSamples& samples,
                       std::size_t i) {
    const MaterialRecord& material = scene.materials[static_cast<std::size_t>(light.material)];
    if (!light.textured && !flat::has_holes(material))
        return scene.textures[static_cast<std::size_t>(material.emission)].color;
    Surface s;
    s.position = samples.position.get<Point3>(i);
    s.position_error = samples.position_error.get<Vec3>(i);
    s.normal = s.shading_normal = samples.normal.get<Normal3>(i);
    s.uv = texture_coordinates_of(scene, samples, i);
    s.material.id = static_cast<std::uint32_t>(light.material);
    return opacity(scene, s) * texture_value(scene, material.emission, s);
}

// Sets the fields of vertex i. The shading normal of `s` is already bent.
void set_fields(const flat::Scene& scene, const MaterialRecord& m, const Surface& s, const Vec3& incoming,
                bsdf::Vertices& v, std::size_t i) {
    // Set what all lobes use.
    v.position.set(i, s.position);
    v.position_error.set(i, s.position_error);
    v.normal.set(i, s.normal);
    v.shading_normal.set(i, s.shading_normal);
    v.incoming.set(i, incoming);
    if (m.lobe == &bsdf::kUserDefined) {
        v.user_defined.resize(bsdf::kShaded);
        v.user_defined[i] = user_defined(scene, s);
        return;
    }
    // Set what limn's own lobes use.
    v.front_face[i] = s.front_face ? 1 : 0;
    v.albedo.set(i, value_or_white(scene, m.albedo, s));
    for (std::size_t k = 0; k < m.lobe->parameters; ++k) v.parameters[k][i] = m.parameters.numbers[k];
    if (!m.lobe->microfacets) return;
    // Set what lobes of microfacets use.
    v.dp_du.set(i, s.dp_du);
    v.factors.set(i, value_or_white(scene, m.factors, s));
    v.albedo_table[i] = m.albedo_table.get();
    v.coat_albedo_table[i] = m.coat_albedo_table.get();
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
        return emits_on(m.sides, s.front_face) ? texture_value(scene, m.emission, s) : Color{};
    if (m.lobe != &bsdf::kUserDefined) return {};
    const bsdf::UserDefined u = user_defined(scene, s);
    return u.thunks->emitted(*u.object, s);
}

Uv texture_coordinates_of(const flat::Scene& scene, const lights::LightSamples& samples, std::size_t i) {
    const flat::Light& light = *samples.light[i];
    if (const auto* sphere = std::get_if<flat::SphereLight>(&light))
        return sphere_uv((samples.position.get<Point3>(i) - sphere->center) / sphere->radius);
    const flat::Place place = flat::locate(scene, std::get<flat::PlanarLight>(light).number);
    const PrimitiveRange& range = scene.ranges[place.range];
    if (range.kind != PrimitiveKind::mesh) return {samples.u[i], samples.v[i]};
    return texture_coordinates(scene.meshes[range.first_row].arrays, place.element, {0, samples.u[i], samples.v[i]});
}

Color radiance_of(const flat::Scene& scene, const lights::LightSamples& samples, std::size_t i) {
    return std::visit(
        [&]<class Kind>(const Kind& light) {
            if constexpr (std::is_base_of_v<flat::SurfaceLight, Kind>)
                return surface_radiance(scene, light, samples, i);
            else
                return light.sampled_radiance(samples.direction.get<Vec3>(i), {samples.u[i], samples.v[i]});
        },
        *samples.light[i]);
}

double opacity(const flat::Scene& scene, const Surface& s) {
    const MaterialRecord& material = record_of(scene, s.material);
    if (!flat::has_holes(material)) return 1;
    const double opacity = texture_value(scene, material.opacity, s).r;
    if (material.opacity_cutoff > 0) return opacity >= material.opacity_cutoff ? 1 : 0;
    return opacity > 0 ? std::min(opacity, 1.0) : 0;
}

Normal3 shading_normal(const flat::Scene& scene, const Surface& s, const Vec3& incoming) {
    const MaterialRecord& m = record_of(scene, s.material);
    if (!has_normal_map(m)) return s.shading_normal;
    return bsdf::bent_normal(s, -normalize(incoming), texture_value(scene, m.normal_map, s));
}

void set_vertex(const flat::Scene& scene, const Surface& s, const Vec3& incoming, bsdf::Vertices& v, std::size_t i) {
    const MaterialRecord& m = record_of(scene, s.material);
    if (!has_normal_map(m)) return set_fields(scene, m, s, incoming, v, i);
    if (m.lobe->one_sided) v.tangent_facets |= std::uint32_t{1} << i;
    Surface bent = s;
    bent.shading_normal = shading_normal(scene, s, incoming);
    set_fields(scene, m, bent, incoming, v, i);
}

}  // namespace limn::shade
