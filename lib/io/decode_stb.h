#pragma once

#include <span>

#include "io/image_codec.h"

namespace limn {

// Decodes the first channels, at most `most`, of a file in memory. stb decodes its format (PictureFormat::stb). \pre
// require_sound() has accepted the file.
// \throws FileError naming `name`
StoredImage decode_stb(FileFormat format, std::span<const std::byte> bytes, const std::string& name, int most = 3);

// Reads the size and the channels of such a file, and decodes no pixels. \pre require_sound() has accepted the file.
// \throws FileError naming `name`
ImageInfo decode_info_stb(FileFormat format, std::span<const std::byte> bytes, const std::string& name);

}  // namespace limn
