// limn's own materials, by the kind that their records name.
#pragma once

#include <string_view>

#include "limn/records.h"

namespace limn {

struct KnownMaterial {
    std::string_view kind;
    const bsdf::Lobe* lobe;  // null: it only absorbs and emits
};

// Null where there is no such kind, or it is user-defined.
const KnownMaterial* known_material(std::string_view kind);

}  // namespace limn
