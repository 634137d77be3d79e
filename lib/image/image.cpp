#include "limn/image/image.h"

#include <new>
#include <stdexcept>
#include <string>

#include "limn/core/error.h"

namespace limn {

namespace {

[[noreturn]] void throw_no_memory(const std::string& size) {
    throw ArgumentError("Image: there is not enough memory for " + size + " pixels");
}

}  // namespace

Image::Image(int width, int height, const Color& fill) : width_(width), height_(height) {
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    if (width <= 0 || height <= 0) throw ArgumentError("Image: both sides must be positive, not " + size);
    try {
        values_.resize(offset(0, height));  // just behind the last row
    } catch (const std::bad_alloc&) {
        throw_no_memory(size);
    } catch (const std::length_error&) {
        throw_no_memory(size);
    }
    const float rgb[3] = {static_cast<float>(fill.r), static_cast<float>(fill.g), static_cast<float>(fill.b)};
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = rgb[i % 3];
}

}  // namespace limn
