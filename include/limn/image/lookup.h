/// \file
/// How an image texture is looked up between and beyond its pixels.
#pragma once

#include <cstdint>

namespace limn {

/// The filter of a lookup. `nearest` takes the pixel that contains the point. `bilinear` interpolates between the four
/// pixels whose centres are around the point.
enum class Filter : std::uint8_t { nearest, bilinear };

/// The continuation of an image outside [0, 1]. `repeat` repeats the image, `clamp` continues its edge, and `mirror`
/// alternates the image and its mirror image.
enum class Wrap : std::uint8_t { repeat, clamp, mirror };

}  // namespace limn
