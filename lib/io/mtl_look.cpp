#include "io/mtl_look.h"

#include <algorithm>
#include <cmath>

namespace limn {

namespace {

// The illumination models of an MTL, as far as limn distinguishes them.
enum class Illum { unsaid, matte, highlight, mirror, transparent };

Illum illum_of(const MtlMaterial& m) {
    if (!m.illumination) return Illum::unsaid;
    switch (*m.illumination) {
        case 2: return Illum::highlight;
        case 3:
        case 5:
        case 8: return Illum::mirror;
        case 4:
        case 6:
        case 7:
        case 9: return Illum::transparent;
        default: return Illum::matte;
    }
}

// Returns true if the material has the picture.
bool is_there(const MtlMap& map) { return !map.name.empty(); }

}  // namespace

MtlLook look_of(const MtlMaterial& m, const MtlColors& colors) {
    const Illum illum = illum_of(m);
    const bool has_highlight = !is_black(colors.specular) || is_there(m.specular_map);
    const bool is_plain = !is_there(m.diffuse_map);
    if (!is_black(colors.emission)) return MtlLook::light;
    if (illum == Illum::transparent && is_plain && !is_there(m.opacity_map)) return MtlLook::glass;
    if (m.metallic) return MtlLook::metallic_roughness;
    if (illum == Illum::matte || !has_highlight) return MtlLook::diffuse;
    const bool outshines = luminance(colors.specular) > luminance(colors.diffuse);
    const bool is_metal = illum == Illum::mirror || (illum == Illum::unsaid && outshines);
    return is_metal && is_plain ? MtlLook::metal : MtlLook::plastic;
}

std::vector<MtlMaterial::Word> words_without_use(const MtlMaterial& m, MtlLook look) {
    std::vector<MtlMaterial::Word> words;
    const auto add = [&](const std::string& word) {
        if (const auto found = m.lines.find(word); found != m.lines.end()) words.push_back({word, found->second});
    };
    if (look == MtlLook::light) {
        for (const MtlMap* map : {&m.diffuse_map, &m.opacity_map, &m.normals}) add(map->word);
        if (m.opacity < 1) add(m.lines.contains("d") ? "d" : "Tr");
    }
    if (look != MtlLook::metal && look != MtlLook::plastic) add("map_Ks");
    if (look == MtlLook::light || is_there(m.normals)) add(m.bump.word);
    if (look == MtlLook::light || look == MtlLook::diffuse) add("Pr");
    if (look != MtlLook::metallic_roughness) add("Pm");
    const Illum illum = illum_of(m);
    // Report illum if the material is not what it asks for.
    const bool is_as_illum_says =
        look == MtlLook::glass || illum == Illum::unsaid || illum == Illum::highlight ||
        (illum == Illum::matte && m.illumination != 10) ||
        (illum == Illum::mirror && (look == MtlLook::metal || look == MtlLook::metallic_roughness));
    if (!is_as_illum_says) add("illum");
    return words;
}

// Returns the roughness: Pr if the material has it. Otherwise the lobe of the microfacets is as wide as a Phong lobe
// with the exponent Ns: alpha = sqrt(2 / (Ns + 2)) (Walter et al., Microfacet Models for Refraction through Rough
// Surfaces, EGSR 2007, section 5.2).
double roughness_of(const MtlMaterial& m) {
    return m.roughness.value_or(std::sqrt(std::min(1.0, std::sqrt(2 / (std::max(m.shininess, 0.0) + 2)))));
}

}  // namespace limn
