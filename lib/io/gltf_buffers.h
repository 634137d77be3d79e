#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/gltf_value.h"
#include "limn/scene/model.h"

namespace limn {

// Returns the path that a URI in a model file refers to. The URI is relative to that file.
std::string gltf_path_beside(const std::string& file, const std::string& uri);

// Reads the binary data of a glTF: buffers, buffer views and accessors. A buffer is read when it is first needed, and
// kept. Errors are FileErrors that name the file and the place in the JSON.
class GltfBuffers {
public:
    // \param chunk the binary chunk of a .glb, or empty; not owned
    // \param path the path of the glTF; not owned
    // \param model gets the paths of all files that are read
    GltfBuffers(const GltfValue& document, std::span<const std::byte> chunk, const std::string& path, Model& model)
        : document_(document), chunk_(chunk), path_(path), model_(model) {}

    // Returns the bytes of a buffer view, given by its number.
    std::span<const std::byte> view(const GltfValue& number);
    // Returns the bytes that a data: URI holds in base64.
    static std::string decode_data(const GltfValue& uri);

    // Returns all values of an accessor, given by its number, one element after the other. Integers are normalised if
    // the accessor says so. The vector is valid as long as this object.
    // \param type the type that the accessor must have, "VEC3" for example
    const std::vector<float>& floats(const GltfValue& number, const std::string& type);
    // Returns all values of an accessor of unsigned integers, given by its number.
    std::vector<std::uint32_t> indices(const GltfValue& number);

private:
    // The location and the type of the elements of an accessor.
    struct Elements {
        std::span<const std::byte> bytes;  // from the first element on; if empty, all elements are zero
        std::size_t stride = 0;            // distance between elements, in bytes
        std::size_t count = 0;             // number of elements
        std::size_t components = 0;        // number of values in an element
        std::uint64_t type = 0;            // the component type
        bool is_normalized = false;        // true if integers stand for [0, 1] or [-1, 1]

        // Returns one value; 0 if `bytes` is empty. \pre otherwise, the value is inside `bytes`
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
    std::map<std::size_t, std::string> buffers_;           // the buffers that have been read, by number
    std::map<std::string, std::vector<float>> accessors_;  // the results of floats(), by GltfValue::place()
    std::uint64_t zeros_ = 0;                              // number of zeros made up for accessors without a view
};

}  // namespace limn
