// What is found out about a picture file before any library decodes it, which might crash, hang or fill the memory.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "io/image_codec.h"

namespace limn {

// The format of a picture, told by its contents, whatever the name. Its header makes sense and the file can hold what
// it promises; a PNG and a JPEG are whole, as every part says. No decoder is handed a file that was not found sound
// here. \throws FileError naming `path` and what the file appears to be
FileFormat require_sound(std::span<const std::byte> file, const std::string& path);

// A header may promise any size. \throws FileError naming `path` if a file of `file_bytes` cannot hold it, or the
// machine cannot
void require_possible_size(int width, int height, int channels, std::size_t file_bytes, const std::string& path);

}  // namespace limn
