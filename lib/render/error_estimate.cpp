#include "render/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "math/elementary.h"
#include "math/parallel.h"
#include "render/pixel_errors.h"
#include "render/window.h"

namespace limn::transport {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kNormal975 = 1.959963984540054;  // the 97.5 % quantile of the standard normal distribution
constexpr int kReach = 2;  // pixels to each side; the mean error of this window estimates the expected error

double square(double x) { return x * x; }

// Returns ErrorEstimate::max_sample_share.
double max_sample_share(const Film& film) {
    std::vector<double> shares;
    shares.reserve(film.pixels());
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) shares.push_back(film.largest_share(x, y));
    // Select the 99.9th percentile. A single firefly would determine the maximum.
    const auto rank = static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(shares.size() - 1));
    std::nth_element(shares.begin(), shares.begin() + rank, shares.end());
    return shares[static_cast<std::size_t>(rank)];
}

// Returns the effective number of pixels: the estimate is as uncertain as the mean over that many pixels of equal
// error. It is (sum of e)^2 / sum of e^2, where e is the expected error of a pixel.
//
// Let a and b be the errors of a pixel's two replicates. The pixel's true error is (a + b)^2 / 4 and its estimate is
// (a - b)^2 / 4, both divided by r^2 + 0.01. Their difference is a b, whose variance is 4 e^2 for every distribution.
//
// e^2 must be estimated. The square of a pixel's estimated error is too large on average: three times e^2 for normal
// replicates, more for skewed ones. The product of the pixel's estimate and the mean estimate of the pixels around it
// is unbiased if all of these have the same e. e^2 is therefore a mixture of two terms. That product has the weight
// 1 - own. A third of the pixel's own square has the weight `own` (PixelErrors::own), which is larger the more the
// pixel differs from those around it. The sum of e^2 is noisy if few pixels dominate it, so one standard error is
// added.
double equal_pixels(const Film& film, const PixelErrors& errors) {
    const int width = film.width(), height = film.height();
    struct Sums {
        double squares = 0, spread = 0;
    };
    // Sum the squares and the squares of the squares of each row.
    std::vector<Sums> rows(static_cast<std::size_t>(height));
    for_each_row(height, [&](int y) {
        Sums& row = rows[static_cast<std::size_t>(y)];
        const auto error_at = [&](int i, int j) { return static_cast<double>(errors.error[film.index(i, j)]); };
        for_each_window(width, height, y, kReach, error_at, [&](int x, double sum, int count) {
            const double error = error_at(x, y), own = count > 1 ? errors.own[film.index(x, y)] : 1;
            const double around = (sum - error) / std::max(1, count - 1);
            const double squared = error * ((1 - own) * around + own * error / 3);
            row.squares += squared;
            row.spread += square(squared);
        });
    });
    Sums all;
    for (const Sums& row : rows) {
        all.squares += row.squares;
        all.spread += row.spread;
    }
    // For n pixels of equal error e, the square of the sum is (n^2 + 2 n) e^2 on average, and the quotient is n + 2.
    return std::clamp(square(errors.sum) / (all.squares + std::sqrt(all.spread)) - 2, 1.0,
                      static_cast<double>(film.pixels()));
}

// Returns the result of a film whose error cannot be estimated.
ErrorEstimate without(const std::string& reason) {
    ErrorEstimate e;
    e.estimate = e.ci95_low = e.ci95_high = kNaN;
    e.reason = reason;
    return e;
}

// Returns the largest PixelErrors::not_found + by_noise for which an estimate is given. `samples` is the mean number of
// samples per pixel. With few samples, only few of the pixels that have light have found it, and these say little about
// the others. At 8 samples, the sum exceeded 0.2 in measured pictures for which the estimate missed two thirds of the
// error or was three times the error.
double most_hidden(double samples) { return samples < 16 ? 0.2 : 3; }

ErrorEstimate estimate(const Film& film, PixelMaps* maps) {
    // Return without an estimate if the film does not allow one.
    if (!film.is_whole()) return without("only some of the picture's pixels are rendered");
    if (film.fewest_samples() < SamplePlan::kFirstPass)
        return without("fewer than " + std::to_string(SamplePlan::kFirstPass) + " samples in a pixel");
    PixelErrors errors = pixel_errors(film);
    if (!std::isfinite(errors.sum)) return without("samples too large for their squares");
    if (errors.not_found + errors.by_noise > most_hidden(film.mean_samples()))
        return without("too much of the noise comes from samples that found light alone in their pixels");
    // Compute the mean over the pixels and its 95 % interval.
    ErrorEstimate e;
    e.estimate = errors.sum / static_cast<double>(film.pixels());
    if (e.estimate > 0) {
        const double deviation =
            std::sqrt(square(ratio_deviation(equal_pixels(film, errors))) + square(errors.by_noise));
        e.ci95_low = e.estimate * exponential(-kNormal975 * deviation - errors.by_surround);
        e.ci95_high = e.estimate * exponential(kNormal975 * deviation + errors.not_found);
    }
    if (maps) maps->error = std::move(errors.error);
    return e;
}

}  // namespace

// The ratio is F-distributed with n and n degrees of freedom, where n is the number of pixels. The variance of its
// logarithm is twice the trigamma function of n / 2. The first three terms of its asymptotic series are used.
double ratio_deviation(double pixels) { return std::sqrt(4 / pixels * (1 + 1 / pixels + 2 / (3 * square(pixels)))); }

ErrorEstimate check_error(const Film& film) { return estimate(film, nullptr); }

ErrorEstimate estimate_error(const Film& film, PixelMaps* maps) {
    if (maps) {
        maps->samples.clear();
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x) maps->samples.push_back(static_cast<float>(film.samples(x, y)));
        maps->error.clear();
    }
    ErrorEstimate e = estimate(film, maps);
    e.max_sample_share = max_sample_share(film);
    return e;
}

namespace {

constexpr std::int64_t kRound = Film::kReplicates;

// Returns samples * factor, rounded down to a multiple of kRound, but at least samples + kRound.
std::int64_t grown(std::int64_t samples, double factor) {
    return std::max(static_cast<std::int64_t>(static_cast<double>(samples) * factor) / kRound * kRound,
                    samples + kRound);
}

// Returns the milestone after `milestone`. Smaller steps would make more checks, and each check may end the render by
// chance before its error is small enough.
std::int64_t next_milestone(std::int64_t milestone) { return grown(milestone, 1.25); }

// Returns the last milestone at or before `samples`, or the first milestone.
std::int64_t last_milestone(int samples) {
    std::int64_t milestone = SamplePlan::kFirstPass;
    while (next_milestone(milestone) <= samples) milestone = next_milestone(milestone);
    return milestone;
}

int as_samples(std::int64_t samples) {
    return static_cast<int>(std::min<std::int64_t>(samples, std::numeric_limits<int>::max() - 1));
}

}  // namespace

bool is_milestone(int samples) { return last_milestone(samples) == samples; }

// The error is assumed to fall no faster than 1 / samples^2. If even then it could not reach the target before the next
// milestone, that milestone is the next check. Otherwise checks are 3 % of the samples apart.
int next_check(int samples, double upper, double target) {
    if (samples < SamplePlan::kFirstPass) return SamplePlan::kFirstPass;
    const std::int64_t milestone = last_milestone(samples), next = next_milestone(milestone);
    if (upper > target * square(static_cast<double>(next) / static_cast<double>(milestone))) return as_samples(next);
    std::int64_t check = milestone;
    while (check <= samples) check = grown(check, 1.03);
    return as_samples(std::min(check, next));
}

// Every round costs each machine a start, so rounds are fewer than checks. A round is as long as the same assumption
// allows: the error cannot reach the target earlier. Its factor is at least 1.05, and at most 4 because the estimate is
// rough while the error is far above the target.
int next_round(int samples, double upper, double target) {
    const double growth = std::isfinite(upper) ? std::clamp(std::sqrt(upper / target), 1.05, 4.0) : 2;
    return as_samples(grown(std::max(samples, SamplePlan::kFirstPass), growth));
}

}  // namespace limn::transport
