// What a film says of the relative error of each of its pixels.
#pragma once

#include <vector>

#include "limn/render/film.h"

namespace limn::transport {

// The relMSE of a pixel is its variance over r^2 + 0.01, r its true value. The difference of the replicates gives the
// variance without bias, but the pixel's own mean is a bad r: where samples are skewed, variance and mean of the same
// samples are high together, and their quotient is too small, so that fireflies hide themselves. The pixels around it
// know r where the picture is smooth. So r is the pixel's own mean as far as the means of the 3x3 pixels differ by more
// than their noise, and the mean of the eight others as far as they do not (Lee, Digital image enhancement and noise
// filtering by use of local statistics, 1980). How large the noise is, a pixel's replicates alone tell badly: it is the
// variance that independent samples would have, which many samples tell, times what the film's points are better by,
// which the 7x7 pixels tell.
struct PixelErrors {
    // Row by row. The estimated relMSE; and to which part r is the pixel's own mean, 0 to 1.
    std::vector<float> error, own;
    double sum = 0;  // of the errors

    // What is uncertain of the sum because r is: each as a part of the sum.
    //
    // By how much it could be smaller or larger, for r^2 is known but for its variance.
    double by_noise = 0;
    // How much of it would not be there if pixels were judged by themselves as far as they differ from those around.
    double by_surround = 0;
    // Error of light that no sample has found, judged by the light that a single sample has found (Good, The population
    // frequencies of species and the estimation of population parameters, 1953), as far as pixels are judged by
    // themselves: in each e-fold of the probability of being found there is as much.
    double not_found = 0;
};

// \pre each replicate of each pixel has a sample. Runs on the threads of the caller's arena, the same on any number.
PixelErrors pixel_errors(const Film& film);

}  // namespace limn::transport
