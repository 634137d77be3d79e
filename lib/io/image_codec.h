// Picture files as they are stored, before any transfer function is undone. Implemented by image_oiio.cpp or, in a
// build without OpenImageIO, image_stb.cpp; in limn's own programs by apps/common/image_loader.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "limn/io/image_io.h"

namespace limn {

enum class FileFormat { exr, png, jpeg, hdr, bmp, tga };

using Facts = std::vector<std::pair<std::string, std::string>>;

// A fact's name in a file carries this prefix, to be told from what other programs write.
inline constexpr const char* kFactPrefix = "limn:";

// What a file says of its transfer function.
enum class Transfer { unsaid, linear, srgb, power };

struct StoredImage {
    int width = 0, height = 0, channels = 0;
    std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<float>> values;
    Transfer transfer = Transfer::unsaid;
    double exponent = 1;  // of Transfer::power: linear = stored ^ exponent
};

// A picture to be written: 8-bit sRGB values for PNG, else linear ones; three channels, alpha, and those of `layers`.
struct EncodeJob {
    FileFormat format = FileFormat::exr;
    int width = 0, height = 0;
    std::variant<std::span<const std::uint8_t>, std::span<const float>> values;
    bool half = false;
    const Facts& facts;
    bool has_alpha = false;             // EXR and PNG
    std::vector<std::string> layers{};  // EXR alone
    std::optional<PartOf> part_of{};    // EXR alone

    int colours() const { return has_alpha ? 4 : 3; }
    int channels() const { return colours() + static_cast<int>(layers.size()); }
};

bool can_encode(FileFormat format);

// The bytes of the file `path`. \throws FileError
std::vector<std::byte> encode(const EncodeJob& job, const std::string& path);

// From bytes that encode() made, or that were found sound (io/image_checks.h). Of the pixels the first channels, at
// most `most`. \throws FileError naming `path`
StoredImage decode(FileFormat format, std::span<const std::byte> bytes, const std::string& path, int most = 3);
ImageInfo decode_header(FileFormat format, std::span<const std::byte> bytes, const std::string& path);

// These functions as a module gives them (apps/common/image_module.cpp).
struct ImageCodec {
    decltype(limn::can_encode)* can_encode;
    decltype(limn::encode)* encode;
    decltype(limn::decode)* decode;
    decltype(limn::decode_header)* decode_header;
};

}  // namespace limn
