#include "io/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/gltf_pictures.h"
#include "io/model_textures.h"
#include "limn/scene/material/alpha_mask.h"
#include "limn/scene/material/diffuse_light.h"
#include "limn/scene/material/metallic_roughness.h"
#include "limn/scene/material/normal_map.h"
#include "limn/scene/material/rough_dielectric.h"
#include "limn/scene/texture/solid.h"
#include "math/elementary.h"

namespace limn {

namespace {

using MaterialPtr = std::shared_ptr<const Material>;
using TexturePtr = std::shared_ptr<const Texture>;
using Values = GltfPictures::Values;

constexpr double kBrightest = 1e38;  // upper bound of an emission, so that an Image can store it as float

double share(double x) { return std::clamp(x, 0.0, 1.0); }

// Returns factor * c, clamped to [0, largest].
Color clamped(const std::vector<double>& c, double factor, double largest) {
    const auto at = [&](std::size_t i) { return std::clamp(factor * c[i], 0.0, largest); };
    return {at(0), at(1), at(2)};
}

// Returns the mean of one channel over all pixels.
double mean_of(const Image& image, std::size_t channel) {
    double sum = 0;
    for (std::size_t i = channel; i < image.values().size(); i += 3) sum += image.values()[i];
    return sum / (static_cast<double>(image.values().size()) / 3);
}

// Converts the materials of a glTF.
class Loader {
public:
    Loader(const GltfValue& document, GltfBuffers& buffers, const std::string& path, const ModelOptions& options,
           Model& model)
        : document_(document), model_(model), pictures_(document, buffers, path, options, model, unused_) {}

    std::vector<GltfMaterial> load() {
        const GltfValue materials = document_["materials"];
        std::vector<GltfMaterial> all;
        for (std::size_t i = 0; i < materials.size(); ++i) {
            made_ = {};
            made_.name = materials[i]["name"].text_or("material " + std::to_string(i));
            unused_.begin(made_.name);
            made_.material = make(materials[i]);
            all.push_back(made_);
        }
        unused_.warn(model_);
        return all;
    }

private:
    MaterialPtr make(const GltfValue& m) {
        const GltfValue base = m["pbrMetallicRoughness"];
        MaterialPtr material = light(m);
        if (!material) {
            material = scattering(m);
            const GltfValue bumps = m["normalTexture"];
            if (const auto picture = pictures_.image(bumps, Values::raw)) {
                const double scale = bumps["scale"].number_or(1);
                const auto normals =
                    scale == 1 ? picture : std::make_shared<const Image>(scaled_normals(*picture, scale));
                material = std::make_shared<NormalMap>(material, texture(bumps, normals, "normalTexture"));
            }
        }
        return masked(std::move(material), m, base["baseColorTexture"],
                      base["baseColorFactor"].numbers_or({1, 1, 1, 1})[3]);
    }

    // Returns a light if the material emits light. Returns null if it does not, or if it has an emissive texture that
    // limn does not use.
    MaterialPtr light(const GltfValue& m) {
        const double strength = m["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"].number_or(1);
        const Color emission = clamped(m["emissiveFactor"].numbers_or({0, 0, 0}), strength, kBrightest);
        const GltfValue emissive_texture = m["emissiveTexture"];
        if (is_black(emission)) return nullptr;
        if (!emissive_texture.exists()) return std::make_shared<DiffuseLight>(emission);
        // An emissive texture is often black except for some spots. If there is a base colour texture as well, make no
        // light, because a light shows no base colour.
        const auto picture = m["pbrMetallicRoughness"]["baseColorTexture"].exists()
                                 ? nullptr
                                 : pictures_.image(emissive_texture, Values::colors, emission, kBrightest);
        if (picture) return std::make_shared<DiffuseLight>(texture(emissive_texture, picture, "emissiveTexture"));
        unused_.note("emissiveTexture");
        return nullptr;
    }

    // Returns the material without its emission, its normal map and its alpha.
    MaterialPtr scattering(const GltfValue& m) {
        const GltfValue base = m["pbrMetallicRoughness"], base_texture = base["baseColorTexture"],
                        surface = base["metallicRoughnessTexture"];
        const Color factor = clamped(base["baseColorFactor"].numbers_or({1, 1, 1, 1}), 1, 1);
        const double metallic = share(base["metallicFactor"].number_or(1)),
                     roughness = share(base["roughnessFactor"].number_or(1));
        const double stated_index = m["extensions"]["KHR_materials_ior"]["ior"].number_or(1.5);
        // An index below 1 counts as the default, 1.5. The specification uses 0 for the extension specular-glossiness,
        // which limn does not read.
        const double index = stated_index >= 1 ? stated_index : 1.5;
        const auto surface_picture = pictures_.image(surface, Values::raw);
        if (const auto glass = this->glass(m, index, metallic, roughness, surface_picture.get())) return glass;

        const auto picture = pictures_.image(base_texture, Values::colors, factor, 1);
        const TexturePtr color =
            picture ? texture(base_texture, picture, "baseColorTexture") : std::make_shared<SolidColor>(factor);
        if (!surface_picture) return metallic_roughness_material(color, metallic, roughness, index);
        return std::make_shared<MetallicRoughness>(color, texture(surface, surface_picture, "metallicRoughnessTexture"),
                                                   metallic, roughness, index);
    }

    // Returns a dielectric if transmissionFactor (1 - metallic) is at least 0.5, else null. Roughness and metallic are
    // their factors times the mean of the texture's green and blue channel.
    // \param surface the metallic-roughness picture, or null
    MaterialPtr glass(const GltfValue& m, double index, double metallic, double roughness, const Image* surface) {
        const GltfValue transmission = m["extensions"]["KHR_materials_transmission"];
        const double factor = transmission["transmissionFactor"].number_or(0);
        if (factor == 0) return nullptr;
        if (transmission["transmissionTexture"].exists()) unused_.note("transmissionTexture");
        if (surface) {
            roughness *= mean_of(*surface, 1);
            metallic *= mean_of(*surface, 2);
        }
        const double share_of_glass = factor * (1 - metallic);
        if (share_of_glass != 1 && metallic != 1) unused_.note("the exact share of transmitted light");
        if (share_of_glass < 0.5) return nullptr;
        // Note what the dielectric does not use.
        const GltfValue base = m["pbrMetallicRoughness"];
        if (surface) unused_.note("the variation of metallicRoughnessTexture");
        if (base["baseColorTexture"].exists()) unused_.note("baseColorTexture");
        if (base["baseColorFactor"].numbers_or({1, 1, 1, 1}) != std::vector<double>{1, 1, 1, 1})
            unused_.note("baseColorFactor");
        return std::make_shared<RoughDielectric>(index, share(roughness));
    }

    // Applies the alpha of a material (glTF 2.0, 3.9.4). In the mode MASK, the surface is opaque where alpha is at
    // least the cutoff, and absent elsewhere. In the mode BLEND, alpha is the opacity.
    MaterialPtr masked(MaterialPtr material, const GltfValue& m, const GltfValue& base_texture, double factor) {
        const std::string mode = m["alphaMode"].text_or("OPAQUE");
        const double cutoff = mode == "MASK" ? m["alphaCutoff"].number_or(0.5) : 0;
        if (mode == "OPAQUE" || (mode == "MASK" && cutoff <= 0)) return material;
        if (mode != "MASK" && mode != "BLEND") {
            unused_.note("alphaMode");
            return material;
        }
        factor = share(factor);
        if (const auto alpha = pictures_.image(base_texture, Values::alpha, {factor, factor, factor}, 1);
            alpha && cutoff <= 1)
            return std::make_shared<AlphaMask>(std::move(material), texture(base_texture, alpha, "alpha"), cutoff);
        const double opacity = mode == "BLEND" ? factor : factor >= cutoff ? 1 : 0;
        if (opacity == 1) return material;
        return std::make_shared<AlphaMask>(std::move(material), opacity);
    }

    // Returns the texture of a picture. All pictures of a material share the texture coordinates and the transform of
    // the first one. If a later picture has other ones, a note says that they are not used.
    // \param info the textureInfo
    // \param name what the note calls the picture
    TexturePtr texture(const GltfValue& info, std::shared_ptr<const Image> picture, const std::string& name) {
        const GltfPlace place = place_of(info);
        if (!made_.has_pictures)
            made_.place = place;
        else if (!(place == made_.place))
            unused_.note("the texCoord or KHR_texture_transform of " + name);
        made_.has_pictures = true;
        return pictures_.texture(info, std::move(picture));
    }

    // Returns the texture coordinates and the transform of a textureInfo. KHR_texture_transform scales, then rotates,
    // then translates.
    static GltfPlace place_of(const GltfValue& info) {
        const GltfValue transform = info["extensions"]["KHR_texture_transform"];
        const std::vector<double> offset = transform["offset"].numbers_or({0, 0}),
                                  scale = transform["scale"].numbers_or({1, 1});
        const auto [s, c] = sine_cosine(transform["rotation"].number_or(0));
        return {.uv_set = transform["texCoord"].natural_or(info["texCoord"].natural_or(0)),
                .u_of = {c * scale[0], s * scale[1], offset[0]},
                .v_of = {-s * scale[0], c * scale[1], offset[1]}};
    }

    GltfValue document_;
    Model& model_;
    GltfUnused unused_;
    GltfPictures pictures_;
    GltfMaterial made_;  // the material that is being converted
};

}  // namespace

std::vector<GltfMaterial> load_gltf_materials(const GltfValue& document, GltfBuffers& buffers, const std::string& path,
                                              const ModelOptions& options, Model& model) {
    return Loader(document, buffers, path, options, model).load();
}

}  // namespace limn
