// What is found out about a picture file before any library decodes it, which might crash, hang or fill the memory.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "io/image_codec.h"

namespace limn {

// By the first bytes, whatever the name. None for what has no mark of its own, as TGA.
std::optional<FileFormat> format_of_contents(std::span<const std::byte> file);

// A PNG and a JPEG end with a mark; every part of a PNG has a checksum. The libraries fill what is missing with grey,
// or do not look. \throws FileError naming `path`
void require_whole(std::span<const std::byte> file, const std::string& path);

// A header may promise any size. \throws FileError naming `path` if a file of `file_bytes` cannot hold it, or the
// machine cannot
void require_possible_size(int width, int height, int channels, std::size_t file_bytes, const std::string& path);

}  // namespace limn
