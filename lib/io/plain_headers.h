// The headers of picture formats without checksums, as far as limn reads them.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace limn {

// What keeps the file from being read safely: a header that makes no sense or is of a kind that is not read, a picture
// that the file cannot hold. Empty if nothing.
std::string hdr_fault(std::span<const std::byte> file);
std::string bmp_fault(std::span<const std::byte> file);
std::string tga_fault(std::span<const std::byte> file);

// A TGA has no mark of its own: every field of its header must be one that the format knows.
bool looks_like_tga(std::span<const std::byte> file);

}  // namespace limn
