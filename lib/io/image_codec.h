// Encodes and decodes picture files. Values are as stored: no transfer function is applied. The functions are
// implemented in image_oiio.cpp or, in a build without OpenImageIO, in image_stb.cpp. limn's own programs use
// apps/common/image_loader.cpp instead.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/picture_formats.h"
#include "limn/io/image_io.h"

namespace limn {

using Facts = std::vector<std::pair<std::string, std::string>>;  // names and values: see SaveOptions::facts

// The prefix of a fact's name in a file. It tells limn's facts from the metadata of other programs.
inline constexpr const char* kFactPrefix = "limn:";

// The transfer function that a file states.
enum class Transfer { unsaid, linear, srgb, power };

// A decoded picture with the values of the file, pixel by pixel, row by row.
struct StoredImage {
    int width = 0, height = 0, channels = 0;
    std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<float>> values;
    Transfer transfer = Transfer::unsaid;
    double exponent = 1;  // if transfer is Transfer::power: linear = stored ^ exponent
};

// A picture to encode. Its channels are red, green, blue, alpha if `has_alpha`, and one for each layer. The values are
// 8-bit sRGB for PNG and linear floats for the other formats. Values and facts are not owned.
struct EncodeJob {
    FileFormat format = FileFormat::exr;
    int width = 0, height = 0;
    std::variant<std::span<const std::uint8_t>, std::span<const float>> values;
    bool half = false;  // true if an EXR stores colours and alpha as half
    const Facts& facts;
    bool has_alpha = false;             // for EXR and PNG
    std::vector<std::string> layers{};  // names of further channels, for EXR
    std::optional<PartOf> part_of{};    // for EXR

    int colours() const { return has_alpha ? 4 : 3; }  // number of channels without the layers
    int channels() const { return colours() + static_cast<int>(layers.size()); }
};

// Returns true if encode() writes the format.
bool can_encode(FileFormat format);

// Returns the bytes of a picture file. \throws FileError naming `path`
std::vector<std::byte> encode(const EncodeJob& job, const std::string& path);

// Decodes the first channels of a picture, at most `most`. \pre encode() has made the bytes, or require_sound() has
// accepted them. \throws FileError naming `path`
StoredImage decode(FileFormat format, std::span<const std::byte> bytes, const std::string& path, int most = 3);
// Reads the header of a picture and decodes no pixels. \pre as for decode(). \throws FileError naming `path`
ImageInfo decode_header(FileFormat format, std::span<const std::byte> bytes, const std::string& path);

// Pointers to these functions, which a module provides (apps/common/image_module.cpp).
struct ImageCodec {
    decltype(limn::can_encode)* can_encode;
    decltype(limn::encode)* encode;
    decltype(limn::decode)* decode;
    decltype(limn::decode_header)* decode_header;
};

}  // namespace limn
