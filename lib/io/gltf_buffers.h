#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/gltf_value.h"
#include "limn/scene/model.h"

namespace limn {

// A path in a model file is relative to that file.
std::string gltf_path_beside(const std::string& file, const std::string& uri);

// The bytes and numbers that a glTF refers to, read when they are asked for.
class GltfBuffers {
public:
    // \param chunk the binary chunk of a .glb, or nothing; it outlives this
    GltfBuffers(const GltfValue& document, std::span<const std::byte> chunk, const std::string& path, Model& model)
        : document_(document), chunk_(chunk), path_(path), model_(model) {}

    // The bytes of a buffer view, given by its number. \throws FileError naming file and place
    std::span<const std::byte> view(const GltfValue& number);
    // The bytes behind the comma of a data: URI in base64.
    static std::string decode_data(const GltfValue& uri);

    // All values of an accessor, given by its number, one after the other; integers are normalised where it says so.
    // \param type "VEC3" and the like
    const std::vector<float>& floats(const GltfValue& number, const std::string& type);
    std::vector<std::uint32_t> indices(const GltfValue& number);

private:
    // Where the elements of an accessor lie.
    struct Elements {
        std::span<const std::byte> bytes;  // from the first on; of none all is zero
        std::size_t stride = 0, count = 0, components = 0;
        std::uint64_t type = 0;
        bool is_normalized = false;

        double at(std::size_t element, std::size_t component) const;
    };

    std::span<const std::byte> buffer(const GltfValue& number);
    std::string read(const GltfValue& buffer);
    Elements elements(const GltfValue& accessor, std::size_t components);
    Elements elements_in(const GltfValue& holder, Elements elements);
    std::vector<double> values(const GltfValue& accessor, std::size_t components);

    GltfValue document_;
    std::span<const std::byte> chunk_;
    const std::string& path_;
    Model& model_;
    std::map<std::size_t, std::string> buffers_;           // that were read
    std::map<std::string, std::vector<float>> accessors_;  // by their places
    std::uint64_t zeros_ = 0;                              // that accessors without a view were given
};

}  // namespace limn
