/// \file
/// Images in memory.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "limn/math/color.h"

namespace limn {

/// A rectangle of pixels: columns [left, right) of rows [top, bottom).
struct PixelBounds {
    /// Columns and rows, counted from the upper left corner of the picture.
    ///@{
    int left = 0, top = 0, right = 0, bottom = 0;
    ///@}

    int width() const { return right - left; }            ///< returns the number of columns
    int height() const { return bottom - top; }           ///< returns the number of rows
    bool operator==(const PixelBounds&) const = default;  ///< compares the bounds
};

/// An image of linear RGB values in float32, which it owns. Pixel (0, 0) is the upper left one. Values are not clamped.
/// Threads may read an image at the same time, and set different pixels at the same time.
class Image {
public:
    Image() = default;  ///< makes an image without pixels
    /// Makes an image of one colour. \throws ArgumentError if a side is not positive, or there is not enough memory
    Image(int width, int height, const Color& fill = {});

    int width() const { return width_; }            ///< returns the width in pixels
    int height() const { return height_; }          ///< returns the height in pixels
    bool empty() const { return values_.empty(); }  ///< returns true if there are no pixels

    /// Returns the pixel in column x, row y. \pre 0 <= x < width(), 0 <= y < height()
    Color at(int x, int y) const {
        const float* p = &values_[offset(x, y)];
        return {p[0], p[1], p[2]};
    }
    /// Sets the pixel in column x, row y, rounded to float32. \pre 0 <= x < width(), 0 <= y < height()
    void set(int x, int y, const Color& c) {
        float* p = &values_[offset(x, y)];
        p[0] = static_cast<float>(c.r);
        p[1] = static_cast<float>(c.g);
        p[2] = static_cast<float>(c.b);
    }

    /// Return the width * height * 3 values: r g b, r g b, ... row by row from the top. The span is valid until the
    /// image is destroyed or assigned to.
    ///@{
    std::span<const float> values() const { return values_; }
    std::span<float> values() { return values_; }
    ///@}

    bool operator==(const Image&) const = default;  ///< compares sizes and values; NaN differs from NaN

private:
    std::size_t offset(int x, int y) const {
        return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
    }
    int width_ = 0, height_ = 0;
    std::vector<float> values_;
};

/// A further channel of an image: one number for each pixel.
struct ImageLayer {
    std::string name;  ///< the channel's name: 1 to 70 printable ASCII characters without blanks, not R, G, B or A
    std::vector<float> values;  ///< one per pixel, row by row from the top left pixel
};

}  // namespace limn
