#include "render/shading.h"

#include "bsdf/dielectric.h"
#include "bsdf/isotropic.h"
#include "bsdf/lambertian.h"
#include "bsdf/metal.h"
#include "pattern/checker.h"
#include "pattern/image_lookup.h"
#include "pattern/perlin.h"

namespace limn::transport {

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

namespace {

const MaterialRecord& record_of(const flat::Scene& scene, const Surface& s) { return scene.materials[s.material.id]; }

// What to call, where the material is somebody else's: on a surface of theirs, or in the table.
struct ForeignMaterial {
    const Material* object = nullptr;
    const MaterialThunks* thunks = nullptr;
};

ForeignMaterial foreign_of(const flat::Scene& scene, const MaterialRef& material) {
    if (material.id == MaterialRef::kObject) return {material.object, material.thunks};
    const MaterialRecord& m = scene.materials[material.id];
    return {m.object, m.thunks};
}

}  // namespace

Color emitted(const flat::Scene& scene, const Surface& s) {
    if (s.material.id == MaterialRef::kNone) return {};
    switch (kind_of(scene, s.material)) {
        case MaterialKind::diffuse_light: return texture_value(scene, record_of(scene, s).texture, s);
        case MaterialKind::foreign: {
            const ForeignMaterial f = foreign_of(scene, s.material);
            return f.thunks->emitted(*f.object, s);
        }
        case MaterialKind::lambertian:
        case MaterialKind::metal:
        case MaterialKind::dielectric:
        case MaterialKind::isotropic: break;
    }
    return {};
}

std::optional<ScatterSample> sample_material(const flat::Scene& scene, const Surface& s, const Vec3& out,
                                             const Random3& random) {
    if (s.material.id == MaterialRef::kNone) return std::nullopt;
    const MaterialKind kind = kind_of(scene, s.material);
    if (kind == MaterialKind::foreign) {
        const ForeignMaterial f = foreign_of(scene, s.material);
        return f.thunks->sample(*f.object, s, out, random);
    }
    const MaterialRecord& m = record_of(scene, s);
    switch (kind) {
        case MaterialKind::lambertian:
            return bsdf::sample_lambertian(texture_value(scene, m.texture, s), s, out, random);
        case MaterialKind::metal:
            return bsdf::sample_metal(texture_value(scene, m.texture, s), m.parameter, s, out, random);
        case MaterialKind::dielectric: return bsdf::sample_dielectric(m.parameter, m.fresnel, s, out, random);
        case MaterialKind::isotropic: return bsdf::sample_isotropic(texture_value(scene, m.texture, s), random);
        case MaterialKind::diffuse_light:
        case MaterialKind::foreign: break;
    }
    return std::nullopt;
}

ScatterValue material_value(const flat::Scene& scene, const Surface& s, const Vec3& out, const Vec3& in) {
    if (s.material.id == MaterialRef::kNone) return {};
    const MaterialKind kind = kind_of(scene, s.material);
    if (kind == MaterialKind::foreign) {
        const ForeignMaterial f = foreign_of(scene, s.material);
        return f.thunks->value(*f.object, s, out, in);
    }
    const MaterialRecord& m = record_of(scene, s);
    switch (kind) {
        case MaterialKind::lambertian: return bsdf::value_lambertian(texture_value(scene, m.texture, s), s, out, in);
        case MaterialKind::metal: return bsdf::value_metal(texture_value(scene, m.texture, s), m.parameter, s, out, in);
        case MaterialKind::isotropic: return bsdf::value_isotropic(texture_value(scene, m.texture, s));
        case MaterialKind::dielectric:
        case MaterialKind::diffuse_light:
        case MaterialKind::foreign: break;
    }
    return {};
}

bool can_be_evaluated(const flat::Scene& scene, const MaterialRef& material) {
    if (material.id == MaterialRef::kNone) return false;
    switch (kind_of(scene, material)) {
        case MaterialKind::lambertian:
        case MaterialKind::isotropic:
        case MaterialKind::foreign: return true;
        case MaterialKind::metal: return scene.materials[material.id].parameter > 0;
        case MaterialKind::dielectric:
        case MaterialKind::diffuse_light: break;
    }
    return false;
}

Color albedo(const flat::Scene& scene, const Surface& s) {
    return texture_value(scene, record_of(scene, s).texture, s);
}

Color radiance_of(const flat::Scene& scene, const flat::Light& light) {
    const MaterialRecord& m = scene.materials[static_cast<std::size_t>(light.material)];
    return scene.textures[static_cast<std::size_t>(m.texture)].color;
}

bool scatters_back_only(const flat::Scene& scene, const MaterialRef& material) {
    if (material.id == MaterialRef::kNone) return true;
    switch (kind_of(scene, material)) {
        case MaterialKind::lambertian:
        case MaterialKind::metal:
        case MaterialKind::diffuse_light: return true;
        case MaterialKind::dielectric:
        case MaterialKind::isotropic:
        case MaterialKind::foreign: break;
    }
    return false;
}

}  // namespace limn::transport
