// Adaptive sampling: which pixels get more samples than others.
#pragma once

#include <span>
#include <vector>

#include "limn/render/film.h"

namespace limn::transport {

// Of the mean. What the first pass has not seen is still found, at worst with four times the variance.
inline constexpr float kSmallestRate = 0.25f, kLargestRate = 64;

// Samples of each pixel, by Film::place, in multiples of their mean over the picture.
//
// The picture's error is the mean of e_i / n_i, where e_i is the relative variance of one sample of pixel i and n_i how
// many it gets. For a given sum of n_i it is least where n_i is proportional to sqrt(e_i) (Neyman, On the two different
// aspects of the representative method, 1934). e_i is taken from the pixels around i and never from i itself: how many
// samples a pixel gets is independent of them, but for the one factor that all share, so that its mean stays unbiased,
// and so does what its replicates say of its variance. Contrast around i counts, too: what no sample has seen yet lies
// at edges. (Weighing by the rays that a sample takes gained nothing.)
//
// \pre the film has SamplePlan::kFirstPass samples in each pixel. Runs on the threads of the caller's arena, the same
// on any number.
std::vector<float> sample_rates(const Film& film);

// SamplePlan::scale for rates of all pixels: the mean over the pixels is then so many samples, or less by a
// 65536th of one. `exact`: by less than two samples in one pixel, after twice the work. It depends on the rates and
// that number alone, so that a render may stop anywhere on its way.
double scale_for(const Film& film, std::span<const float> rates, int samples, bool exact);

}  // namespace limn::transport
