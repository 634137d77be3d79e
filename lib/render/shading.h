// Materials and textures of the compiled scene: the packed ones without a virtual call, foreign ones through thunks.
#pragma once

#include <optional>

#include "flat/scene.h"
#include "limn/core/surface.h"
#include "shade/lobes.h"

namespace limn::transport {

Color texture_value(const flat::Scene& scene, TextureId id, const Surface& s);

// The same three questions as Material's.
Color emitted(const flat::Scene& scene, const Surface& s);
std::optional<ScatterSample> sample_material(const flat::Scene& scene, const Surface& s, const Vec3& out,
                                             const Random3& random);
ScatterValue material_value(const flat::Scene& scene, const Surface& s, const Vec3& out, const Vec3& in);

// False for materials whose value is zero for every pair of directions: lights need not be sampled for them.
bool can_be_evaluated(const flat::Scene& scene, const MaterialRef& material);

// Foreign where the material is somebody else's. \pre material.id != MaterialRef::kNone
inline MaterialKind kind_of(const flat::Scene& scene, const MaterialRef& material) {
    return material.id == MaterialRef::kObject ? MaterialKind::foreign : scene.materials[material.id].kind;
}

inline bool can_emit(const flat::Scene& scene, const MaterialRef& material) {
    if (material.id == MaterialRef::kNone) return false;
    const MaterialKind kind = kind_of(scene, material);
    return kind == MaterialKind::diffuse_light || kind == MaterialKind::foreign;
}

// By which a material scatters that is shaded side by side with others; it does not emit.
inline std::optional<shade::Lobe> lobe_of(const flat::Scene& scene, const MaterialRef& material) {
    if (material.id == MaterialRef::kNone) return std::nullopt;
    switch (kind_of(scene, material)) {
        case MaterialKind::lambertian: return shade::Lobe::lambertian;
        case MaterialKind::isotropic: return shade::Lobe::isotropic;
        case MaterialKind::dielectric: return shade::Lobe::dielectric;
        case MaterialKind::metal:
        case MaterialKind::diffuse_light:
        case MaterialKind::foreign: break;
    }
    return std::nullopt;
}

// What that lobe is scaled by. \pre lobe_of(scene, s.material)
Color albedo(const flat::Scene& scene, const Surface& s);

// Radiance of a light, the same everywhere. \pre !light.textured
Color radiance_of(const flat::Scene& scene, const flat::Light& light);

// Whether the value is zero wherever the two directions are on different sides of the geometric surface. False in
// media, which have no sides.
bool scatters_back_only(const flat::Scene& scene, const MaterialRef& material);

}  // namespace limn::transport
