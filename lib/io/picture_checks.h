// Checks the headers of picture files before they are decoded. The functions check_... throw a Fault if a file is not
// sound. require_sound() in image_checks.h calls them.
#pragma once

#include <vector>

#include "io/bytes.h"

namespace limn {

inline constexpr const char* kNoPixels = "it has no pixels";

// Returns the text of a Fault: the file is too short for a picture of this size.
inline std::string too_short_for(std::uint64_t width, std::uint64_t height) {
    return "it is too short for a picture of " + std::to_string(width) + " x " + std::to_string(height);
}

// Check that the header is valid and of a kind that limn reads, and that the file can hold the picture.
void check_hdr(std::span<const std::byte> file);
void check_bmp(std::span<const std::byte> file);
void check_tga(std::span<const std::byte> file);

// Returns true if every field of the header has a value that TGA allows. A TGA has no mark to recognise.
bool looks_like_tga(std::span<const std::byte> file);

// Checks the headers of an EXR, because OpenEXR allocates whatever size they state. Refuses an attribute that is larger
// than the file, a picture or a table of chunks that the file cannot hold, and deep pixels. Does not check the chunks.
void check_exr(std::span<const std::byte> file);

// Checks a JPEG from its first marker to its last: the order of segments, the sizes of Huffman tables, and that the
// file can hold the picture.
void check_jpeg(std::span<const std::byte> file);

// Checks a PNG from its first chunk to its last: the order and the checksums of chunks, and that the file can hold the
// picture.
void check_png(std::span<const std::byte> file);

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
