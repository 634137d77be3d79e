/// \file
/// The error between two images.
#pragma once

#include <cstdint>

#include "limn/image/image.h"

namespace limn {

/// All sums in double over every pixel and the three linear channels, no trimming. NaN where a value is undefined, as
/// all are once one value is not finite.
struct ImageMetrics {
    double relative_mse = 0;  ///< mean of (x - r)^2 / (r^2 + 0.01)
    double mse = 0;           ///< mean of (x - r)^2
    double smape = 0;         ///< mean of 2 |x - r| / (|x| + |r|), 0 where both are 0
    double psnr_srgb = 0;     ///< -10 log10 of the mean square difference, in dB, of the sRGB-encoded images clamped to
                              ///< [0, 1]; +infinity for equal ones
    double largest_relative = 0;            ///< largest |x - r| / sqrt(r^2 + 0.01)
    int largest_x = 0;                      ///< its column; if invalid, that of the first value that is not finite
    int largest_y = 0;                      ///< its row; if invalid, that of the first value that is not finite
    double worst_share = 0;                 ///< share of the relative_mse sum that the worst 0.1 % of the values carry
    std::uint64_t nonfinite_test = 0;       ///< values, not pixels
    std::uint64_t nonfinite_reference = 0;  ///< values, not pixels
    bool valid = true;                      ///< false as soon as one value is not finite

    bool has_reference_error = false;   ///< whether two halves of the reference were given
    double reference_relative_mse = 0;  ///< of the mean of the halves: mean of ((a - b) / 2)^2 / (r^2 + 0.01)
    double corrected_relative_mse = 0;  ///< relative_mse - reference_relative_mse
    bool reference_too_noisy = false;   ///< the reference's own error is over a tenth of relative_mse
};

/// Pure. \throws ArgumentError if the sizes differ or the images are empty
ImageMetrics compare_images(const Image& test, const Image& reference);

/// With the reference in two independent halves: compares with their mean and subtracts its own error.
/// \throws ArgumentError if the sizes differ or the images are empty
ImageMetrics compare_images(const Image& test, const Image& reference_a, const Image& reference_b);

/// Each value's part of relMSE, (x - r)^2 / (r^2 + 0.01), of which ImageMetrics::relative_mse is the mean. NaN where a
/// value is not finite.
/// \throws ArgumentError if the sizes differ or the images are empty
Image error_image(const Image& test, const Image& reference);

/// With the mean of the two halves as the reference, whose own error is not subtracted.
/// \throws ArgumentError if the sizes differ or the images are empty
Image error_image(const Image& test, const Image& reference_a, const Image& reference_b);

/// An error image for the eye: each pixel's mean over the channels by its logarithm, from black at 1e-6 and below over
/// blue (1e-5), purple (1e-4), red (1e-3), orange (1e-2) and yellow (1e-1) to white at 1 and above. Linear colours that
/// sRGB encodes to steps of even size. Green where there is a NaN.
Image false_colour(const Image& error);

}  // namespace limn
