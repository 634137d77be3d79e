// What becomes of an MTL's material: the table of docs/models.md.
#pragma once

#include "io/mtl.h"

namespace limn {

enum class MtlLook { light, glass, metallic_roughness, metal, plastic, diffuse };

// In the ranges that materials allow.
struct MtlColors {
    Color emission, diffuse, specular;
};

MtlLook look_of(const MtlMaterial& m, const MtlColors& colors);

// The words that limn knows, but that this material has no use for.
std::vector<MtlMaterial::Word> words_without_use(const MtlMaterial& m, MtlLook look);

// Of the microfacets, see Roughness.
double roughness_of(const MtlMaterial& m);

}  // namespace limn
