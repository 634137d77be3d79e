/// \file
/// The error between two images. Implemented in lib/image/compare.cpp and error_image.cpp.
#pragma once

#include <cstdint>

#include "limn/image/image.h"

namespace limn {

/// The error of a test image against a reference. In the formulas x is a value of the test image and r the value of the
/// reference. Means are over all pixels and the three linear channels, in double; no values are left out. If a value of
/// either image is not finite, the comparison is invalid and all errors are NaN.
///
/// A reference may be given as two halves, a and b. They are two renders with different seeds and equally many samples.
/// The reference is then their mean, r = (a + b) / 2.
struct ImageMetrics {
    /// relMSE: mean of (x - r)^2 / (r^2 + 0.01). It is the relative mean squared error of Rousselle et al., Adaptive
    /// Sampling and Reconstruction using Greedy Error Minimization, ACM TOG 30(6), 2011. Without the constant 0.01, a
    /// black pixel of the reference would make it infinite, and pixels much darker than 0.1 would dominate it.
    double relative_mse = 0;
    double mse = 0;  ///< mean of (x - r)^2
    /// Symmetric mean absolute percentage error: mean of 2 |x - r| / (|x| + |r|), whose term is 0 where both are 0. It
    /// is the adjusted MAPE of Armstrong, Long-Range Forecasting, 1985, p. 348, with absolute values in the
    /// denominator.
    double smape = 0;
    /// Peak signal-to-noise ratio in dB: -10 log10 of the mean of (e(x) - e(r))^2, where e clamps to [0, 1] and encodes
    /// as sRGB. It is +infinity if no encoded value differs.
    double psnr_srgb = 0;
    double largest_relative = 0;  ///< the largest |x - r| / sqrt(r^2 + 0.01)
    int largest_x = 0;            ///< column of that value; if invalid, of the first value that is not finite
    int largest_y = 0;            ///< row of that value; if invalid, of the first value that is not finite
    /// The part of relative_mse that the largest 0.1 % of its terms, at least one, sum up to. NaN if relative_mse is 0.
    double worst_share = 0;
    std::uint64_t nonfinite_test = 0;       ///< number of values of the test image that are not finite
    std::uint64_t nonfinite_reference = 0;  ///< number of values of the reference that are not finite
    bool valid = true;                      ///< false if a value is not finite

    bool has_reference_error = false;  ///< true if the reference was given as two halves
    /// The estimated relMSE of the reference, from its halves: mean of ((a - b) / 2)^2 / (r^2 + 0.01).
    double reference_relative_mse = 0;
    double corrected_relative_mse = 0;  ///< relative_mse - reference_relative_mse
    bool reference_too_noisy = false;   ///< true if reference_relative_mse is over a tenth of relative_mse
};

/// Returns the error of `test` against `reference`. Pure.
/// \throws ArgumentError if the sizes differ or the images are empty
ImageMetrics compare_images(const Image& test, const Image& reference);

/// Returns the error of `test` against a reference that is given as two halves (see ImageMetrics). The difference of
/// the halves gives the error of the reference, which is subtracted in corrected_relative_mse. Pure.
/// \throws ArgumentError if the sizes differ or the images are empty
ImageMetrics compare_images(const Image& test, const Image& reference_a, const Image& reference_b);

/// Returns (x - r)^2 / (r^2 + 0.01) for each value; ImageMetrics::relative_mse is the mean of these. A value that is
/// not finite gives NaN.
/// \throws ArgumentError if the sizes differ or the images are empty
Image error_image(const Image& test, const Image& reference);

/// Returns the error image against a reference that is given as two halves (see ImageMetrics). The error of the
/// reference is not subtracted.
/// \throws ArgumentError if the sizes differ or the images are empty
Image error_image(const Image& test, const Image& reference_a, const Image& reference_b);

/// Returns an error image in false colours. The mean of a pixel's channels, on a logarithmic scale, selects its colour:
/// black up to 1e-6, blue at 1e-5, purple at 1e-4, red at 1e-3, orange at 1e-2, yellow at 1e-1, white from 1 on. A
/// pixel with a NaN is green. Colours are interpolated as encoded sRGB values; the result is linear.
Image false_colour(const Image& error);

}  // namespace limn
