/// \file
/// How an image is read between and beyond its pixels.
#pragma once

#include <cstdint>

namespace limn {

/// Which pixels count: the one that the point lies in, or the four whose centres are around it, by their nearness.
enum class Filter : std::uint8_t { nearest, bilinear };

/// What lies outside [0, 1]: the image again, its edge, or its mirror image.
enum class Wrap : std::uint8_t { repeat, clamp, mirror };

}  // namespace limn
