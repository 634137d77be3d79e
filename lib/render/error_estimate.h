// What a film knows of its own error, and when that is little enough.
#pragma once

#include "limn/render/film.h"
#include "limn/render/render.h"

namespace limn::transport {

// The estimate of the picture's relMSE, its interval and max_sample_share; on the threads of the caller's arena, the
// same on any number of them. `maps`, if given, gets each pixel's part.
ErrorEstimate estimate_error(const Film& film, PixelMaps* maps = nullptr);

// The same without max_sample_share: less work.
ErrorEstimate check_error(const Film& film);

// The standard deviation of the logarithm of true over estimated error, where the estimate is worth so many pixels of
// equal error, at least 1.
double ratio_deviation(double pixels);

// When a render to an error asks its film: at milestones, which are the same for every target, a quarter apart, and
// between two of them only where the error may reach the target before the second, in steps of 3 %. So a render that
// goes on to a smaller target asks where it would have asked if it had begun with that. In multiples of 2.
//
// The first check after so many samples a pixel; `upper` is the upper end of the interval at the last milestone, NaN
// where that is unknown.
int next_check(int samples, double upper, double target);
bool is_milestone(int samples);

// After how many samples films of several machines are to be merged and asked again; `upper` is the upper end of their
// interval after `samples`, which is over `target`, or NaN where that is unknown.
int next_round(int samples, double upper, double target);

}  // namespace limn::transport
