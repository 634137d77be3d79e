#include <algorithm>
#include <cmath>
#include <limits>

#include "image/compare_values.h"
#include "limn/image/compare.h"
#include "limn/math/color.h"

namespace limn {

namespace {

// Returns the relative squared errors of a test image. reference(i) returns value i of the reference in double.
template <class Reference>
Image relative_errors(const Image& test, const Reference& reference) {
    Image error(test.width(), test.height());
    for (std::size_t i = 0; i < error.values().size(); ++i) {
        const double e = relative_squared_error(test.values()[i], reference(i));
        error.values()[i] = std::isfinite(e) ? static_cast<float>(e) : std::numeric_limits<float>::quiet_NaN();
    }
    return error;
}

// The colours of the scale, encoded as sRGB. Neighbours are a decade apart.
constexpr Color kScale[] = {{0, 0, 0},        {0.05, 0.1, 0.5}, {0.45, 0.1, 0.55}, {0.8, 0.15, 0.25},
                            {0.95, 0.5, 0.1}, {1, 0.9, 0.3},    {1, 1, 1}};
constexpr double kLowestDecade = -6;  // log10 of the error at the first colour

// Returns the linear colour of an error.
Color colour_of(double error) {
    if (std::isnan(error)) return {0, 1, 0};
    constexpr double kLast = static_cast<double>(std::size(kScale)) - 1;
    const double place = std::clamp(std::log10(error) - kLowestDecade, 0.0, kLast);
    const auto i = static_cast<std::size_t>(std::min(place, kLast - 1));
    const double along = place - static_cast<double>(i);
    const Color encoded = (1 - along) * kScale[i] + along * kScale[i + 1];
    return {srgb_decode(encoded.r), srgb_decode(encoded.g), srgb_decode(encoded.b)};
}

}  // namespace

Image error_image(const Image& test, const Image& reference) {
    require_same_size(test, reference, "error_image");
    return relative_errors(test, [r = reference.values()](std::size_t i) { return static_cast<double>(r[i]); });
}

Image error_image(const Image& test, const Image& reference_a, const Image& reference_b) {
    require_same_size(test, reference_a, "error_image");
    require_same_size(test, reference_b, "error_image");
    return relative_errors(test, [a = reference_a.values(), b = reference_b.values()](std::size_t i) {
        return mean_of_halves(a[i], b[i]);
    });
}

Image false_colour(const Image& error) {
    Image image(error.width(), error.height());
    for (int y = 0; y < error.height(); ++y)
        for (int x = 0; x < error.width(); ++x) {
            const Color e = error.at(x, y);
            image.set(x, y, colour_of((e.r + e.g + e.b) / 3));
        }
    return image;
}

}  // namespace limn
