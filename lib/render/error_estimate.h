// The estimate of a film's own error, and the sample counts at which a render to a target error checks it.
#pragma once

#include "limn/render/film.h"
#include "limn/render/render.h"

namespace limn::transport {

// Returns the estimate of the picture's relMSE with its 95 % interval and max_sample_share. If `maps` is given, its
// `samples` are set, and its `error` is set if there is an estimate and emptied if not. Runs on the threads of the
// caller's TBB arena; the result does not depend on their number.
ErrorEstimate estimate_error(const Film& film, PixelMaps* maps = nullptr);

// Returns the same estimate, but leaves max_sample_share at 0, which saves work.
ErrorEstimate check_error(const Film& film);

// Returns the standard deviation of log(true error / estimated error) if the estimate is the mean over `pixels` pixels
// of equal error. \pre pixels >= 1
double ratio_deviation(double pixels);

// A render to a target error checks its error at certain numbers of samples per pixel, all of them multiples of 2:
// - at milestones, which are the same for every target. Each is a quarter larger than the one before.
// - between two milestones in steps of 3 %, but only if the error may reach the target before the second milestone.
// A render that is continued to a smaller target therefore makes the checks that it would have made if it had begun
// with that target.
//
// Returns the number of samples per pixel at the first check after `samples`. `upper` is the upper end of the 95 %
// interval at the last milestone: NaN if it is unknown, infinite if there was no estimate.
int next_check(int samples, double upper, double target);
// True if `samples` is a milestone.
bool is_milestone(int samples);

// Returns the number of samples per pixel after which the films of several machines are merged and checked again.
// `upper` is the upper end of the 95 % interval after `samples`. It is above `target`, or NaN if it is unknown.
int next_round(int samples, double upper, double target);

}  // namespace limn::transport
