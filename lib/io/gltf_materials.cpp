#include "io/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "io/text_lines.h"
#include "limn/io/image_io.h"
#include "limn/material/dielectric.h"
#include "limn/material/diffuse_light.h"
#include "limn/material/lambertian.h"
#include "limn/material/metal.h"
#include "limn/texture/image_texture.h"

namespace limn {

namespace {

constexpr double kBrightest = 1e38;  // that a picture of float holds

Color color_of(const std::vector<double>& c) { return {c[0], c[1], c[2]}; }

Color clamped(const Color& c, double largest) {
    return {std::clamp(c.r, 0.0, largest), std::clamp(c.g, 0.0, largest), std::clamp(c.b, 0.0, largest)};
}

// Of red, green or blue over all pixels.
double mean_of(const Image& image, std::size_t channel) {
    double sum = 0;
    for (std::size_t i = channel; i < image.values().size(); i += 3) sum += image.values()[i];
    return sum / (static_cast<double>(image.values().size()) / 3);
}

// A word that materials have and limn does not use.
struct Unused {
    std::string word, first;
    std::size_t others = 0;
};

class Loader {
public:
    Loader(const GltfValue& document, GltfBuffers& buffers, const std::string& path, const ModelOptions& options,
           Model& model)
        : document_(document), buffers_(buffers), path_(path), options_(options), model_(model) {}

    std::vector<GltfMaterial> load() {
        const GltfValue materials = document_["materials"];
        std::vector<GltfMaterial> all;
        for (std::size_t i = 0; i < materials.size(); ++i) {
            GltfMaterial& made = all.emplace_back();
            made.name = materials[i]["name"].text_or("material " + std::to_string(i));
            name_ = made.name;
            made.material = make(materials[i], made);
        }
        for (const auto& [word, first, others] : unused_)
            model_.warnings.push_back(word + " of material " + in_quotes(first) + " is not used" +
                                      (others == 0 ? "" : ", nor in " + std::to_string(others) + " more"));
        return all;
    }

private:
    // The first that fits: light, glass, metal, matte.
    std::shared_ptr<const Material> make(const GltfValue& m, GltfMaterial& made) {
        const GltfValue base = m["pbrMetallicRoughness"], extensions = m["extensions"];
        const GltfValue base_texture = base["baseColorTexture"];
        const Color factor = clamped(color_of(base["baseColorFactor"].numbers_or({1, 1, 1, 1})), 1);
        if (m["normalTexture"].exists()) note("normalTexture");
        if (m["alphaMode"].text_or("OPAQUE") != "OPAQUE") note("alphaMode");

        const double strength = extensions["KHR_materials_emissive_strength"]["emissiveStrength"].number_or(1);
        const Color emission = clamped(strength * color_of(m["emissiveFactor"].numbers_or({0, 0, 0})), kBrightest);
        const GltfValue emissive_texture = m["emissiveTexture"];
        if (!is_black(emission)) {
            if (!emissive_texture.exists()) return std::make_shared<DiffuseLight>(emission);
            // A picture that is black but for some spots is no reason to leave the base colour out.
            const auto picture =
                base_texture.exists() ? nullptr : texture(emissive_texture, emission, kBrightest, made);
            if (picture) return std::make_shared<DiffuseLight>(picture);
            note("emissiveTexture");
        }
        if (extensions["KHR_materials_transmission"]["transmissionFactor"].number_or(0) >= 0.5) {
            const double index = extensions["KHR_materials_ior"]["ior"].number_or(1.5);
            return std::make_shared<Dielectric>(index > 0 ? index : 1.5);
        }
        double metallic = base["metallicFactor"].number_or(1), roughness = base["roughnessFactor"].number_or(1);
        const GltfValue roughness_texture = base["metallicRoughnessTexture"];
        if (const auto picture = image(roughness_texture, Encoding::raw)) {
            roughness *= mean_of(*picture, 1), metallic *= mean_of(*picture, 2);
            note("metallicRoughnessTexture (but for its mean)");
        }
        const auto picture = texture(base_texture, factor, 1, made);
        if (metallic >= 0.5) {
            const double fuzz = std::clamp(roughness * roughness, 0.0, 1.0);
            return picture ? std::make_shared<Metal>(picture, fuzz) : std::make_shared<Metal>(factor, fuzz);
        }
        return picture ? std::make_shared<Lambertian>(picture) : std::make_shared<Lambertian>(factor);
    }

    // A picture times a factor; null if there is none that can be read.
    std::shared_ptr<const Texture> texture(const GltfValue& info, const Color& factor, double largest,
                                           GltfMaterial& made) {
        const auto picture = image(info, Encoding::automatic);
        if (!picture) return nullptr;
        const std::array<double, 3> scale{factor.r, factor.g, factor.b};
        Image scaled = *picture;
        for (std::size_t i = 0; i < scaled.values().size(); ++i) {
            const double value = double{scaled.values()[i]} * scale[i % 3];
            scaled.values()[i] = static_cast<float>(value > 0 ? std::min(value, largest) : 0);
        }
        place(info, made);
        return std::make_shared<ImageTexture>(std::move(scaled), sampler(info));
    }

    // KHR_texture_transform: scaled, turned, moved.
    static void place(const GltfValue& info, GltfMaterial& made) {
        const GltfValue transform = info["extensions"]["KHR_texture_transform"];
        made.uv_set = transform["texCoord"].natural_or(info["texCoord"].natural_or(0));
        const std::vector<double> offset = transform["offset"].numbers_or({0, 0}),
                                  scale = transform["scale"].numbers_or({1, 1});
        const double angle = transform["rotation"].number_or(0), c = std::cos(angle), s = std::sin(angle);
        made.u_of = {c * scale[0], s * scale[1], offset[0]};
        made.v_of = {-s * scale[0], c * scale[1], offset[1]};
    }

    // The numbers of OpenGL.
    ImageTextureOptions sampler(const GltfValue& info) const {
        const GltfValue number = info["index"].in(document_["textures"])["sampler"];
        ImageTextureOptions options;
        if (!number.exists()) return options;
        constexpr std::uint64_t kNearest = 9728, kClamp = 33071, kMirror = 33648, kRepeat = 10497;
        const GltfValue sampler = number.in(document_["samplers"]);
        if (sampler["magFilter"].natural_or(0) == kNearest) options.filter = Filter::nearest;
        const std::uint64_t wrap = sampler["wrapS"].natural_or(kRepeat);
        if (wrap == kClamp) options.wrap = Wrap::clamp;
        if (wrap == kMirror) options.wrap = Wrap::mirror;
        return options;
    }

    // The picture that a texture shows; null, with a warning, if it cannot be read.
    std::shared_ptr<const Image> image(const GltfValue& info, Encoding encoding) {
        if (!info.exists() || !options_.textures) return nullptr;
        const GltfValue source = info["index"].in(document_["textures"])["source"];
        if (!source.exists()) {
            note("a texture without a source");
            return nullptr;
        }
        const GltfValue image = source.in(document_["images"]);
        const auto [found, is_new] = images_.try_emplace({image.place(), encoding});
        if (is_new) try {
                found->second = std::make_shared<const Image>(load(image, encoding));
            } catch (const FileError& error) {
                model_.warnings.emplace_back(error.what());
            }
        return found->second;
    }

    Image load(const GltfValue& image, Encoding encoding) {
        const std::string uri = image["uri"].text_or(""), name = path_ + ": " + image.place();
        if (uri.empty()) return load_image_from_memory(buffers_.view(image["bufferView"]), encoding, name);
        if (!uri.starts_with("data:")) {
            model_.files.push_back(gltf_path_beside(path_, uri));
            return load_image(model_.files.back(), encoding);
        }
        const std::string bytes = GltfBuffers::decode_data(image["uri"]);
        return load_image_from_memory(std::as_bytes(std::span(bytes)), encoding, name);
    }

    void note(const std::string& word) {
        const auto found =
            std::find_if(unused_.begin(), unused_.end(), [&](const Unused& u) { return u.word == word; });
        if (found == unused_.end())
            unused_.push_back({word, name_});
        else
            ++found->others;
    }

    GltfValue document_;
    GltfBuffers& buffers_;
    const std::string& path_;
    const ModelOptions& options_;
    Model& model_;
    std::map<std::pair<std::string, Encoding>, std::shared_ptr<const Image>> images_;
    std::vector<Unused> unused_;
    std::string name_;  // of the current material
};

}  // namespace

std::vector<GltfMaterial> load_gltf_materials(const GltfValue& document, GltfBuffers& buffers, const std::string& path,
                                              const ModelOptions& options, Model& model) {
    return Loader(document, buffers, path, options, model).load();
}

}  // namespace limn
