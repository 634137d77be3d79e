#include "material/lobes.h"

#include <algorithm>

#include "bsdf/lobe.h"

// X(namespace of the lobe, kind) for each material that scatters.
#define LIMN_FOR_EACH_LOBE(X)                   \
    X(lambertian, "lambertian")                 \
    X(metal, "metal")                           \
    X(dielectric, "dielectric")                 \
    X(isotropic, "isotropic")                   \
    X(metallic_roughness, "metallic-roughness") \
    X(oren_nayar, "oren-nayar")                 \
    X(plastic, "plastic")                       \
    X(rough_conductor, "rough-conductor")       \
    X(rough_dielectric, "rough-dielectric")

namespace limn {

#define LIMN_DECLARE_LOBE(name, kind) \
    namespace name {                  \
    extern const bsdf::Lobe kLobe;    \
    }
LIMN_FOR_EACH_LOBE(LIMN_DECLARE_LOBE)

std::span<const KnownMaterial> known_materials() {
#define LIMN_LIST_LOBE(name, kind) {kind, &name::kLobe},
    static constexpr KnownMaterial kAll[] = {LIMN_FOR_EACH_LOBE(LIMN_LIST_LOBE){"diffuse-light", nullptr}};
    return kAll;
}

const KnownMaterial* known_material(std::string_view kind) {
    const std::span all = known_materials();
    const auto found = std::ranges::find(all, kind, &KnownMaterial::kind);
    return found != all.end() ? &*found : nullptr;
}

}  // namespace limn
