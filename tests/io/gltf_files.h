// glTF files made by the tests.
#pragma once

#include <cmath>
#include <string>

#include "broken_models.h"
#include "limn/image/image.h"
#include "limn/io/image_io.h"
#include "limn/io/model.h"
#include "limn/math/color.h"
#include "support/folder.h"

namespace limn::test {

inline std::string base64(const std::string& bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

inline std::string data_uri(const std::string& bytes, const std::string& type = "application/octet-stream") {
    return "data:" + type + ";base64," + base64(bytes);
}

// Four corners of a square of side 1, then their texture coordinates, then six indices of 16 bits.
inline std::string square_bytes() {
    return floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) + floats({0, 1, 1, 1, 1, 0, 0, 0}) + little(0, 2) +
           little(1, 2) + little(2, 2) + little(0, 2) + little(2, 2) + little(3, 2);
}

// The square as a glTF. `uri` is a member of the buffer, with its comma, or nothing.
inline std::string square_gltf(const std::string& uri) {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0, "name": "square"}],
"materials": [{"name": "red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1], "metallicFactor": 0}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
 {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
 {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}],
"bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 32},
 {"buffer": 0, "byteOffset": 80, "byteLength": 12}],
"buffers": [{)" +
           uri + R"("byteLength": 92}]})";
}

inline std::string embedded_square() { return square_gltf("\"uri\": \"" + data_uri(square_bytes()) + "\", "); }

inline std::string glb_chunk(const std::string& type, std::string data, char filler) {
    while (data.size() % 4 != 0) data += filler;
    return little(data.size(), 4) + type + data;
}

inline std::string glb(const std::string& json, const std::string& binary) {
    const std::string chunks = glb_chunk("JSON", json, ' ') + glb_chunk(std::string("BIN\0", 4), binary, '\0');
    return "glTF" + little(2, 4) + little(12 + chunks.size(), 4) + chunks;
}

inline const std::string kSquare = embedded_square();

// The square with changes.
inline std::string with(const std::string& what, const std::string& by) { return replaced(kSquare, what, by); }

inline std::string with_material(const std::string& members) {
    return with(R"("name": "red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1], "metallicFactor": 0})",
                members);
}

inline Model load(const std::string& bytes, const ModelOptions& options = {}) {
    const Folder folder;
    return load_model(folder.write("a.model", bytes), options);
}

template <class Kind>
bool is_of(const Model& model) {
    return dynamic_cast<const Kind*>(model.meshes.at(0)->materials().at(1).get()) != nullptr;
}

inline double distance(const Color& a, const Color& b) {
    return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
}

// Red, green; blue, white: from the top left, in bytes of a picture.
inline std::string four_pixels(const Folder& folder, const std::string& suffix = ".png") {
    Image image(2, 2);
    image.set(0, 0, {1, 0, 0});
    image.set(1, 0, {0, 1, 0});
    image.set(0, 1, {0, 0, 1});
    image.set(1, 1, {1, 1, 1});
    save_image(image, folder.path("four" + suffix));
    return folder.read("four" + suffix);
}

inline const std::string kTextured =
    R"("pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {"index": 0}})";

inline std::string with_texture(const std::string& image, const std::string& material = kTextured) {
    return replaced(with_material(material), "\"materials\"",
                    R"("textures": [{"source": 0, "sampler": 0}], "samplers": [{"magFilter": 9728}],
"images": [{)" + image + "}], \"materials\"");
}

}  // namespace limn::test
