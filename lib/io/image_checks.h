// Checks a picture file before a library decodes it. On a file that is not sound, a library might crash, hang or fill
// the memory.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "io/image_codec.h"

namespace limn {

// Checks that a picture is sound, and returns its format, which is recognised by its contents. In a sound file, the
// header is valid and the file is large enough for the picture that the header states. A PNG or a JPEG is complete; all
// checksums of a PNG are right. Decoders are only given files that this function has accepted.
// \throws FileError naming `path` if the file is not sound or of a format that limn does not read
FileFormat require_sound(std::span<const std::byte> file, const std::string& path);

// Checks the size of a picture that a header states.
// \throws FileError naming `path` if a dimension is not positive, if a file of `file_bytes` bytes cannot hold the
// picture, or if the machine has too little memory for it
void require_possible_size(int width, int height, int channels, std::size_t file_bytes, const std::string& path);

}  // namespace limn
