// Lookup of an image at texture coordinates.
#pragma once

#include "limn/image/image.h"
#include "limn/image/lookup.h"
#include "limn/math/vec.h"

namespace limn::pattern {

/// Returns the colour of the image at (u, v). The image covers the closed unit square, with u to the right and v
/// upward. Filter::nearest reads texel (int(u W), int((1 - v) H)), the last column at u = 1 and the last row at v = 0.
/// Coordinates outside the square are wrapped as `wrap_u` and `wrap_v` say. NaN is read as 0.
/// \pre the image is not empty
Color lookup_image(const Image& image, const Uv& uv, Filter filter, Wrap wrap_u, Wrap wrap_v);
inline Color lookup_image(const Image& image, const Uv& uv, Filter filter, Wrap wrap) {
    return lookup_image(image, uv, filter, wrap, wrap);
}

}  // namespace limn::pattern
