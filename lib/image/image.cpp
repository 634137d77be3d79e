#include "limn/image/image.h"

#include <exception>
#include <string>

#include "limn/math/error.h"

namespace limn {

Image::Image(int width, int height, const Color& fill) : width_(width), height_(height) {
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    if (width <= 0 || height <= 0) throw ArgumentError("Image: both sides must be positive, not " + size);
    try {
        values_.resize(offset(0, height));  // the offset of the first pixel past the end
    } catch (const std::exception&) {       // bad_alloc or length_error
        throw ArgumentError("Image: there is not enough memory for " + size + " pixels");
    }
    const float rgb[3] = {static_cast<float>(fill.r), static_cast<float>(fill.g), static_cast<float>(fill.b)};
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = rgb[i % 3];
}

}  // namespace limn
