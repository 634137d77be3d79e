// Helpers of the functions that check picture files (picture_formats.h), and the chunks of a PNG.
#pragma once

#include <vector>

#include "io/bytes.h"
#include "io/picture_formats.h"

namespace limn {

inline constexpr const char* kNoPixels = "it has no pixels";

// Returns the text of a Fault: the file is too short for a picture of this size.
inline std::string too_short_for(std::uint64_t width, std::uint64_t height) {
    return "it is too short for a picture of " + std::to_string(width) + " x " + std::to_string(height);
}

// A chunk of a PNG. Its members are views of the file.
struct PngChunk {
    std::string_view type, data;
    std::span<const std::byte> type_and_data;
    std::uint64_t stated_crc;
};

// Returns the chunks of a PNG from the first one to the first one with pixels. stb reads neither the transfer function
// nor the texts in them. \pre check_png() has accepted the file
std::vector<PngChunk> png_header_chunks(std::span<const std::byte> file);

// Returns the bytes of a chunk, its length and its checksum included.
std::string png_chunk(const std::string& type, const std::string& data);
// The size of the signature and the first chunk, which is the image header. More chunks may be inserted here.
inline constexpr std::ptrdiff_t kPngHeaderEnd = 8 + 4 + 4 + 13 + 4;

}  // namespace limn
