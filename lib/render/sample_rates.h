// Adaptive sampling: how the samples of a render are distributed over its pixels.
#pragma once

#include <span>
#include <vector>

#include "limn/render/film.h"

namespace limn::transport {

// The limits of a rate, in multiples of the mean rate. With the smallest rate, light that the first pass has missed is
// still found, at worst with four times the variance.
inline constexpr float kSmallestRate = 0.25f, kLargestRate = 64;

// Returns the rates of a SamplePlan: the number of samples of each pixel in multiples of the mean, by Film::place.
//
// The picture's error is the mean of e_i / n_i, where e_i is the relative variance of one sample of pixel i and n_i its
// number of samples. For a given sum of n_i, the error is smallest if n_i is proportional to sqrt(e_i) (Neyman, On the
// two different aspects of the representative method, 1934).
//
// e_i is estimated from the pixels around i, never from i itself. The number of samples of a pixel is then independent
// of their values, except for one factor that all pixels share. So the pixel's mean stays unbiased, and so does the
// variance that its replicates give. The contrast around i is added to e_i, because features that no sample has hit yet
// are usually at edges. Weighting by the number of rays per sample as well gained nothing.
//
// Runs on the threads of the caller's TBB arena; the result does not depend on their number.
// \pre the film has SamplePlan::kFirstPass samples in each pixel
std::vector<float> sample_rates(const Film& film);

// Returns the SamplePlan::scale at which the pixels get `samples` samples on average, or up to 1/65536 of a sample
// less. If `exact`, the sum over all pixels is less than two samples short, which takes twice the work. The result
// depends on the rates and `samples` alone, so a render may be interrupted at any point.
// \pre `rates` has all pixels of the picture
double scale_for(const Film& film, std::span<const float> rates, int samples, bool exact);

}  // namespace limn::transport
