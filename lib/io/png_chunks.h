// The chunks of a PNG file that stb neither reads nor writes: what the colours mean, and text.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace limn {

struct PngChunk {
    std::string type;  // four letters
    std::string data;
};

// The chunks before the pixels; those of a broken file as far as they go, none if it is no PNG.
std::vector<PngChunk> png_header_chunks(std::span<const std::byte> file);

// What keeps a PNG from being one from its first chunk to its last, with every checksum right; empty if nothing.
std::string png_fault(std::span<const std::byte> file);

// `file` with chunks added behind its first one, the image header.
std::vector<std::byte> insert_png_chunks(std::span<const std::byte> file, const std::vector<PngChunk>& chunks);

}  // namespace limn
