/// \file
/// The error between two images.
#pragma once

#include <cstdint>

#include "limn/image/image.h"

namespace limn {

/// The error of a test image against a reference. In the formulas x is a value of the test image and r the value of the
/// reference. Means are over all pixels and the three linear channels, in double; no values are left out. If a value of
/// either image is not finite, the comparison is invalid and all errors are NaN.
struct ImageMetrics {
    double relative_mse = 0;  ///< mean of (x - r)^2 / (r^2 + 0.01)
    double mse = 0;           ///< mean of (x - r)^2
    double smape = 0;         ///< mean of 2 |x - r| / (|x| + |r|), 0 where both are 0
    /// -10 log10 of the mean squared difference of the images, clamped to [0, 1] and encoded as sRGB; in dB. It is
    /// +infinity for equal images.
    double psnr_srgb = 0;
    double largest_relative = 0;       ///< the largest |x - r| / sqrt(r^2 + 0.01)
    int largest_x = 0;                 ///< column of that value; if invalid, of the first value that is not finite
    int largest_y = 0;                 ///< row of that value; if invalid, of the first value that is not finite
    double worst_share = 0;            ///< share of the worst 0.1 % of the values in relative_mse; NaN if that is 0
    std::uint64_t nonfinite_test = 0;  ///< number of values of the test image that are not finite
    std::uint64_t nonfinite_reference = 0;  ///< number of values of the reference that are not finite
    bool valid = true;                      ///< false if a value is not finite

    bool has_reference_error = false;  ///< true if the reference was given in two halves
    /// The error of the mean r of the two halves a and b of the reference: mean of ((a - b) / 2)^2 / (r^2 + 0.01).
    double reference_relative_mse = 0;
    double corrected_relative_mse = 0;  ///< relative_mse - reference_relative_mse
    bool reference_too_noisy = false;   ///< true if reference_relative_mse is over a tenth of relative_mse
};

/// Returns the error of `test` against `reference`. Pure.
/// \throws ArgumentError if the sizes differ or the images are empty
ImageMetrics compare_images(const Image& test, const Image& reference);

/// Returns the error of `test` against the mean of two independent halves of a reference. The difference of the halves
/// gives the error of the reference, which is subtracted in corrected_relative_mse. Pure.
/// \throws ArgumentError if the sizes differ or the images are empty
ImageMetrics compare_images(const Image& test, const Image& reference_a, const Image& reference_b);

/// Returns (x - r)^2 / (r^2 + 0.01) for each value; ImageMetrics::relative_mse is the mean of these. A value that is
/// not finite gives NaN.
/// \throws ArgumentError if the sizes differ or the images are empty
Image error_image(const Image& test, const Image& reference);

/// Returns the error image against the mean of two halves of a reference. The error of the reference is not subtracted.
/// \throws ArgumentError if the sizes differ or the images are empty
Image error_image(const Image& test, const Image& reference_a, const Image& reference_b);

/// Returns an error image in false colours. The mean of a pixel's channels, on a logarithmic scale, selects its colour:
/// black up to 1e-6, blue at 1e-5, purple at 1e-4, red at 1e-3, orange at 1e-2, yellow at 1e-1, white from 1 on. A
/// pixel with a NaN is green. Colours are interpolated as encoded sRGB values; the result is linear.
Image false_colour(const Image& error);

}  // namespace limn
