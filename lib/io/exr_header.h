// The header of an EXR file, which OpenEXR believes: it allocates what an attribute's size says.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace limn {

// What keeps the headers of an EXR from being read safely: an attribute that is larger than the file, a picture or a
// table of chunks that the file cannot hold, deep samples. Empty if nothing. Chunks are not looked at.
std::string exr_fault(std::span<const std::byte> file);

}  // namespace limn
