// Reading an image at texture coordinates.
#pragma once

#include "limn/core/vec.h"
#include "limn/image/image.h"
#include "limn/image/lookup.h"

namespace limn::pattern {

/// The image spread over the closed unit square, u to the right, v upward. Nearest reads texel
/// (int(u W), int((1 - v) H)), the last column at u = 1 and the last row at v = 0. Beyond the square `wrap` counts. NaN
/// reads as 0.
/// \pre the image is not empty
Color lookup_image(const Image& image, const Uv& uv, Filter filter, Wrap wrap_u, Wrap wrap_v);
inline Color lookup_image(const Image& image, const Uv& uv, Filter filter, Wrap wrap) {
    return lookup_image(image, uv, filter, wrap, wrap);
}

}  // namespace limn::pattern
