// The headers of picture files, held against the file before any decoder believes them.
#pragma once

#include <vector>

#include "io/bytes.h"

namespace limn {

inline constexpr const char* kNoPixels = "it has no pixels";

inline std::string too_short_for(std::uint64_t width, std::uint64_t height) {
    return "it is too short for a picture of " + std::to_string(width) + " x " + std::to_string(height);
}

// A header that makes no sense or is of a kind that is not read, or a picture that the file cannot hold. \throws Fault
void check_hdr(std::span<const std::byte> file);
void check_bmp(std::span<const std::byte> file);
void check_tga(std::span<const std::byte> file);

// A TGA has no mark of its own: every field of its header must be one that the format knows.
bool looks_like_tga(std::span<const std::byte> file);

// OpenEXR allocates what an attribute's size says: an attribute that is larger than the file, a picture or a table of
// chunks that the file cannot hold, deep samples. Chunks are not looked at. \throws Fault
void check_exr(std::span<const std::byte> file);

// A JPEG is one from its first marker to its last, with tables that fit their arrays and a size that the file can hold.
// \throws Fault
void check_jpeg(std::span<const std::byte> file);

// A PNG is one from its first chunk to its last, with every checksum right. \throws Fault
void check_png(std::span<const std::byte> file);

struct PngChunk {
    std::string_view type, data;
    std::span<const std::byte> type_and_data;
    std::uint64_t stated_crc;
};

// The chunks before the pixels of a PNG that was found sound. stb reads neither what its colours mean nor its text.
std::vector<PngChunk> png_header_chunks(std::span<const std::byte> file);

// A chunk's bytes, and the place for more of them behind the first one, the image header.
std::string png_chunk(const std::string& type, const std::string& data);
inline constexpr std::ptrdiff_t kPngHeaderEnd = 8 + 4 + 4 + 13 + 4;

}  // namespace limn
