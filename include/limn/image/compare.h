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

}  // namespace limn
