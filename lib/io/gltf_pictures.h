// The pictures of a glTF, as textures.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "io/gltf_buffers.h"
#include "limn/io/image_io.h"
#include "limn/io/model.h"
#include "limn/texture/image_texture.h"

namespace limn {

// What materials have and limn does not use, for one warning a word.
class GltfUnused {
public:
    void begin(const std::string& material) { material_ = material; }
    void note(const std::string& word);
    void warn(Model& model) const;

private:
    struct Word {
        std::string word, first;
        std::size_t others = 0;
    };
    std::vector<Word> words_;
    std::string material_;
};

// Each picture is read once for each way that its values are read, whatever number of textures show it.
class GltfPictures {
public:
    GltfPictures(const GltfValue& document, GltfBuffers& buffers, const std::string& path, const ModelOptions& options,
                 Model& model, GltfUnused& unused)
        : document_(document), buffers_(buffers), path_(path), options_(options), model_(model), unused_(unused) {}

    enum class Values { colors, raw, alpha };

    // The picture that a textureInfo shows; null if there is none, and, with a warning, if it cannot be read. Of alpha
    // also null if it has none.
    std::shared_ptr<const Image> image(const GltfValue& info, Values values);
    // The same times a factor, between 0 and `largest`.
    std::shared_ptr<const Image> image(const GltfValue& info, Values values, const Color& factor, double largest);
    // With the sampler of the texture.
    std::shared_ptr<const Texture> texture(const GltfValue& info, std::shared_ptr<const Image> image) const;

private:
    Image load(const GltfValue& image, Values values);

    using Key = std::pair<std::string, Values>;
    Key key_of(const GltfValue& info, Values values) const;

    GltfValue document_;
    GltfBuffers& buffers_;
    const std::string& path_;
    const ModelOptions& options_;
    Model& model_;
    GltfUnused& unused_;
    std::map<Key, std::shared_ptr<const Image>> images_;
    std::map<std::tuple<Key, double, double, double>, std::shared_ptr<const Image>> scaled_;
};

}  // namespace limn
