// Reads the pictures of a glTF and makes textures of them.
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
#include "limn/scene/texture/image_texture.h"

namespace limn {

// Collects the properties of materials that limn does not use. There is one warning for each property, however many
// materials have it.
class GltfUnused {
public:
    // Sets the material that the following notes are about.
    void begin(const std::string& material) { material_ = material; }
    // Notes that a property of the material is not used.
    void note(const std::string& word);
    // Adds the warnings to the model.
    void warn(Model& model) const;

private:
    struct Word {
        std::string word;        // a property
        std::string first;       // the first material that has it
        std::size_t others = 0;  // number of further notes
    };
    std::vector<Word> words_;
    std::string material_;
};

// Reads pictures and makes textures. A picture is read once for each Values, however many textures use it.
class GltfPictures {
public:
    GltfPictures(const GltfValue& document, GltfBuffers& buffers, const std::string& path, const ModelOptions& options,
                 Model& model, GltfUnused& unused)
        : document_(document), buffers_(buffers), path_(path), options_(options), model_(model), unused_(unused) {}

    // The way in which the values of a picture are read: as colours, decoded to linear ones; as they are stored; or the
    // alpha channel alone.
    enum class Values { colors, raw, alpha };

    // Returns the picture of a textureInfo. Returns null if there is none, if ModelOptions::textures is false, if alpha
    // is wanted and the picture has none, or, with a warning, if it cannot be read.
    std::shared_ptr<const Image> image(const GltfValue& info, Values values);
    // Returns the picture multiplied by a factor and clamped to [0, largest].
    std::shared_ptr<const Image> image(const GltfValue& info, Values values, const Color& factor, double largest);
    // Returns a texture that shows `image` with the filter and the wrap mode of the textureInfo's sampler; null if
    // `image` is null.
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
    std::map<Key, std::shared_ptr<const Image>> images_;  // null for a picture that cannot be read
    std::map<std::tuple<Key, double, double, double>, std::shared_ptr<const Image>> scaled_;  // by key and factor
};

}  // namespace limn
