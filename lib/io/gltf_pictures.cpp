#include "io/gltf_pictures.h"

#include <algorithm>
#include <utility>

#include "io/model_textures.h"
#include "io/text_lines.h"
#include "math/system/read_file.h"

namespace limn {

void GltfUnused::note(const std::string& word) {
    const auto found = std::ranges::find(words_, word, &Word::word);
    if (found == words_.end())
        words_.push_back({word, material_});
    else
        ++found->others;
}

void GltfUnused::warn(Model& model) const {
    for (const auto& [word, first, others] : words_)
        model.warnings.push_back(word + " of material " + in_quotes(first) + " is not used" +
                                 (others == 0 ? "" : ", nor in " + std::to_string(others) + " more"));
}

// Identifies a picture file by its URI, and a picture in a buffer or in a data: URI by its place in the JSON.
GltfPictures::Key GltfPictures::key_of(const GltfValue& info, Values values) const {
    const GltfValue image = info["index"].in(document_["textures"])["source"].in(document_["images"]);
    const std::string uri = image["uri"].text_or("");
    return {uri.empty() || uri.starts_with("data:") ? image.place() : uri, values};
}

std::shared_ptr<const Image> GltfPictures::image(const GltfValue& info, Values values) {
    if (!info.exists() || !options_.textures) return nullptr;
    const GltfValue source = info["index"].in(document_["textures"])["source"];
    if (!source.exists()) {
        unused_.note("a texture without a source");
        return nullptr;
    }
    const auto [found, is_new] = images_.try_emplace(key_of(info, values));
    if (is_new) try {
            Image loaded = load(source.in(document_["images"]), values);
            if (!loaded.empty()) found->second = std::make_shared<const Image>(std::move(loaded));
        } catch (const FileError& error) {
            if (std::ranges::find(model_.warnings, error.what()) == model_.warnings.end())
                model_.warnings.emplace_back(error.what());
        }
    return found->second;
}

std::shared_ptr<const Image> GltfPictures::image(const GltfValue& info, Values values, const Color& factor,
                                                 double largest) {
    const auto picture = image(info, values);
    if (!picture) return nullptr;
    auto& known = scaled_[{key_of(info, values), factor.r, factor.g, factor.b}];
    if (!known) {
        const auto is_within = [&](float v) { return v >= 0 && v <= largest; };
        const bool is_same = factor == Color{1, 1, 1} && std::ranges::all_of(picture->values(), is_within);
        known = is_same ? picture : std::make_shared<const Image>(scaled(*picture, factor, largest));
    }
    return known;
}

// The filters and wrap modes of a sampler are numbers of OpenGL.
std::shared_ptr<const Texture> GltfPictures::texture(const GltfValue& info, std::shared_ptr<const Image> image) const {
    if (!image) return nullptr;
    const GltfValue number = info["index"].in(document_["textures"])["sampler"];
    ImageTextureOptions options;
    if (number.exists()) {
        constexpr std::uint64_t kNearest = 9728, kClamp = 33071, kMirror = 33648, kRepeat = 10497;
        const GltfValue sampler = number.in(document_["samplers"]);
        if (sampler["magFilter"].natural_or(0) == kNearest) options.filter = Filter::nearest;
        const std::uint64_t wrap = sampler["wrapS"].natural_or(kRepeat);
        if (sampler["wrapT"].natural_or(kRepeat) != wrap) unused_.note("a wrapT other than its wrapS");
        if (wrap == kClamp) options.wrap = Wrap::clamp;
        if (wrap == kMirror) options.wrap = Wrap::mirror;
    }
    return std::make_shared<ImageTexture>(std::move(image), options);
}

// Reads a picture from its file, its data: URI or its buffer view. Returns an empty Image if alpha is wanted and the
// picture has none. Colours are sRGB whatever the file says (glTF 2.0, 3.9.2). Those of EXR and HDR, which the
// specification does not mention, are linear.
Image GltfPictures::load(const GltfValue& image, Values values) {
    // Get the bytes.
    const std::string uri = image["uri"].text_or("");
    const bool is_file = !uri.empty() && !uri.starts_with("data:");
    const std::string name = is_file ? gltf_path_beside(path_, uri) : path_ + ": " + image.place();
    if (is_file && std::ranges::find(model_.files, name) == model_.files.end()) model_.files.push_back(name);
    const std::string text = is_file ? read_file(name) : uri.empty() ? "" : GltfBuffers::decode_data(image["uri"]);
    const auto bytes = uri.empty() ? buffers_.view(image["bufferView"]) : std::as_bytes(std::span(text));
    // Decode them.
    if (values == Values::alpha) return load_alpha_from_memory(bytes, name).value_or(Image{});
    Encoding encoding = Encoding::raw;
    if (values == Values::colors) {
        const std::string type = load_image_info_from_memory(bytes, name).channels.at(0).type;
        if (type != "half" && type != "float") encoding = Encoding::srgb;
    }
    return load_image_from_memory(bytes, encoding, name);
}

}  // namespace limn
