// The lobes of limn's own materials.
#pragma once

#include "limn/records/records.h"

// X(namespace of the lobe) for each material that scatters.
#define LIMN_FOR_EACH_LOBE(X) \
    X(lambertian)             \
    X(metal)                  \
    X(dielectric)             \
    X(isotropic)              \
    X(metallic_roughness)     \
    X(oren_nayar)             \
    X(plastic)                \
    X(rough_conductor)        \
    X(rough_dielectric)

namespace limn {

#define LIMN_DECLARE_LOBE(name)    \
    namespace name {               \
    extern const bsdf::Lobe kLobe; \
    }
LIMN_FOR_EACH_LOBE(LIMN_DECLARE_LOBE)

struct KnownLobe {
    const char* name;
    const bsdf::Lobe* lobe;
};
#define LIMN_LIST_LOBE(name) {#name, &name::kLobe},
inline constexpr KnownLobe kKnownLobes[] = {LIMN_FOR_EACH_LOBE(LIMN_LIST_LOBE)};

}  // namespace limn
