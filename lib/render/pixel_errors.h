// The estimated relative error of each pixel of a film.
#pragma once

#include <vector>

#include "limn/render/film.h"

namespace limn::transport {

// The relMSE of a pixel is its variance divided by r^2 + 0.01, where r is its true value. The variance is estimated
// without bias from the difference of the replicates. r must be estimated too:
// - The pixel's own mean is a bad estimate. If samples are skewed, the variance and the mean of the same samples are
//   large together. Their quotient is too small, and fireflies hide themselves.
// - The mean of the eight pixels around it is a good estimate if the picture is smooth there.
// r is interpolated between the two. The pixel's own mean gets more weight, the more the means of the 3x3 pixels differ
// beyond their noise (Lee, Digital image enhancement and noise filtering by use of local statistics, 1980).
//
// The noise of a mean is estimated too. Two replicates alone give a poor estimate. The variance that independent
// samples would have is well known from all samples of the pixel. It is multiplied by the ratio of the film's variance
// to that of independent samples, which is taken over the 7x7 pixels around.
struct PixelErrors {
    // The estimated relMSE of each pixel, row by row.
    std::vector<float> error;
    // The weight of the pixel's own mean in r, 0 to 1, row by row.
    std::vector<float> own;
    double sum = 0;  // the sum of `error`

    // The uncertainty of `sum` that comes from that of r. Each number is a fraction of `sum`.

    // How much smaller or larger `sum` could be because of the variance of r.
    double by_noise = 0;
    // How much smaller `sum` would be if r were the pixel's own mean, with weight `own`.
    double by_surround = 0;
    // The error due to light that no sample has found. It is estimated from the light that a single sample has found
    // (Good, The population frequencies of species and the estimation of population parameters, 1953), with weight
    // `own`. It is assumed to be equal in each e-fold of the probability that a sample finds the light.
    double not_found = 0;
};

// Estimates the errors. Runs on the threads of the caller's TBB arena; the result does not depend on their number.
// \pre each replicate of each pixel has a sample
PixelErrors pixel_errors(const Film& film);

}  // namespace limn::transport
