#pragma once

#include <span>

#include "io/image_codec.h"

namespace limn {

// Decodes a PNG, JPEG, HDR, BMP or TGA file in memory, which was found sound. Of the pixels the first channels, at most
// `most`.
// \throws FileError naming `name`
StoredImage decode_stb(FileFormat format, std::span<const std::byte> bytes, const std::string& name, int most = 3);

// Reads the header alone. \throws FileError naming `name`
ImageInfo decode_info_stb(FileFormat format, std::span<const std::byte> bytes, const std::string& name);

}  // namespace limn
