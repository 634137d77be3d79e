/// \file
/// Pixels in memory.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "limn/core/color.h"

namespace limn {

/// Pixels of a picture: columns [left, right) of rows [top, bottom), counted from its upper left corner.
struct PixelBounds {
    /// As said above.
    ///@{
    int left = 0, top = 0, right = 0, bottom = 0;
    ///@}

    int width() const { return right - left; }            ///< in pixels
    int height() const { return bottom - top; }           ///< in pixels
    bool operator==(const PixelBounds&) const = default;  ///< the same pixels
};

/// An owning image of linear RGB float32, rows from the top, pixels from the left. Values are not clamped. Reading is
/// thread-safe, and so is setting different pixels.
class Image {
public:
    Image() = default;  ///< no pixels
    /// \throws ArgumentError if a side is not positive, or memory lacks
    Image(int width, int height, const Color& fill = {});

    int width() const { return width_; }            ///< in pixels
    int height() const { return height_; }          ///< in pixels
    bool empty() const { return values_.empty(); }  ///< no pixels

    /// \pre 0 <= x < width(), 0 <= y < height()
    Color at(int x, int y) const {
        const float* p = &values_[offset(x, y)];
        return {p[0], p[1], p[2]};
    }
    /// Rounds to float32. \pre as for `at`
    void set(int x, int y, const Color& c) {
        float* p = &values_[offset(x, y)];
        p[0] = static_cast<float>(c.r), p[1] = static_cast<float>(c.g), p[2] = static_cast<float>(c.b);
    }

    /// width * height * 3 values: r g b, r g b, ... Valid as long as the image.
    ///@{
    std::span<const float> values() const { return values_; }
    std::span<float> values() { return values_; }
    ///@}

    bool operator==(const Image&) const = default;  ///< sizes and values; an image with a NaN equals nothing

private:
    std::size_t offset(int x, int y) const {
        return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
    }
    int width_ = 0, height_ = 0;
    std::vector<float> values_;
};

/// A number for each pixel beside its colour.
struct ImageLayer {
    std::string name;           ///< of the channel: 1 to 70 printable characters, not R, G, B or A
    std::vector<float> values;  ///< row by row from the top left pixel
};

}  // namespace limn
