// What a film knows of its own error, and when that is little enough.
#pragma once

#include "limn/render/render.h"
#include "render/film.h"

namespace limn::tracing {

// The estimate of the picture's relMSE, its interval and max_sample_share; on the threads of the caller's arena, the
// same on any number of them. `maps`, if given, gets each pixel's part.
ErrorEstimate estimate_error(const Film& film, PixelMaps* maps = nullptr);

// The same without max_sample_share: less work.
ErrorEstimate check_error(const Film& film);

// The standard deviation of the logarithm of true over estimated error, where the estimate is worth so many pixels of
// equal error, at least 1.
double ratio_deviation(double pixels);

// After how many samples the film is to be asked again, in multiples of 2: `upper` is the upper end of its interval
// after `samples`, over `target`.
int next_check(int samples, double upper, double target);

}  // namespace limn::tracing
