// limn's own materials, by the kind that their records name.
#pragma once

#include <span>
#include <string_view>

#include "limn/records.h"

namespace limn {

struct KnownMaterial {
    std::string_view kind;
    const bsdf::Lobe* lobe;  // null: it only absorbs and emits
};

std::span<const KnownMaterial> known_materials();
// Null where there is no such kind, or it is user-defined.
const KnownMaterial* known_material(std::string_view kind);

}  // namespace limn
