// The segments of a JPEG file, which its decoders believe.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace limn {

// What keeps a JPEG from being one from its first marker to its last, with tables that fit their arrays and a size that
// the file can hold; empty if nothing.
std::string jpeg_fault(std::span<const std::byte> file);

}  // namespace limn
