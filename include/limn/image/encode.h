/// \file
/// Pixels as displays and 8-bit files have them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limn/image/image.h"

namespace limn {

/// 8-bit pixels with the transfer of sRGB (IEC 61966-2-1), as PNG has them: r g b, r g b, ... row by row from the top
/// left one, each clamped to [0, 1] and rounded to the nearest step; a NaN becomes 0.
/// \param exposure in stops: colours are multiplied by 2^exposure first
/// \param alpha empty, or a value in [0, 1] for each pixel, by which its colour is multiplied: then r g b a, ..., of
/// which the colour is divided by it again, as PNG wants it
/// \throws ArgumentError if the exposure is not finite, or alpha has not one value a pixel
std::vector<std::uint8_t> encode_srgb8(const Image& image, double exposure = 0, std::span<const float> alpha = {});

}  // namespace limn
