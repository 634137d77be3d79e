/// \file
/// 8-bit sRGB pixels for displays and files.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limn/image/image.h"

namespace limn {

/// Returns the pixels in 8 bits with the sRGB transfer function (IEC 61966-2-1): r g b, r g b, ... row by row from the
/// top left pixel. Values are clamped to [0, 1] and rounded to the nearest step. A NaN becomes 0.
/// \param image linear colours; if `alpha` is given, multiplied by it (associated alpha)
/// \param exposure in stops: colours are multiplied by 2^exposure before they are encoded
/// \param alpha empty, or a value in [0, 1] for each pixel. The result is then r g b a, r g b a, ... with colours
/// divided by alpha (unassociated alpha), as in a PNG. The colour is black where alpha is 0.
/// \throws ArgumentError if the exposure is not finite, or alpha has not one value for each pixel
std::vector<std::uint8_t> encode_srgb8(const Image& image, double exposure = 0, std::span<const float> alpha = {});

}  // namespace limn
