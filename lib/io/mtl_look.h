// Decides which material of limn an MTL's material becomes: the table in docs/models.md.
#pragma once

#include "io/mtl.h"

namespace limn {

enum class MtlLook { light, glass, metallic_roughness, metal, plastic, diffuse };

// The colours of an MTL's material, clamped to the ranges that limn's materials allow.
struct MtlColors {
    Color emission, diffuse, specular;
};

// Returns the kind of material that an MTL's material becomes.
MtlLook look_of(const MtlMaterial& m, const MtlColors& colors);

// Returns the keywords of a material that limn reads but does not use for a material of this kind.
std::vector<MtlMaterial::Word> words_without_use(const MtlMaterial& m, MtlLook look);

// Returns the roughness in the convention of limn/scene/material/roughness.h.
double roughness_of(const MtlMaterial& m);

}  // namespace limn
