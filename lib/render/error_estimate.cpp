#include "render/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/elementary.h"
#include "render/parallel.h"
#include "render/pixel_errors.h"
#include "render/window.h"

namespace limn::transport {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kNormal975 = 1.959963984540054;
constexpr int kReach = 2;  // pixels to each side whose errors tell what that of the one between is on average

double square(double x) { return x * x; }

double max_sample_share(const Film& film) {
    std::vector<double> shares;
    shares.reserve(film.pixels());
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) shares.push_back(film.largest_share(x, y));
    // Not the largest: one pixel in a thousand may hold a firefly.
    const auto rank = static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(shares.size() - 1));
    std::nth_element(shares.begin(), shares.begin() + rank, shares.end());
    return shares[static_cast<std::size_t>(rank)];
}

// How many pixels of equal error the estimate is worth: the square of the sum of the errors over the sum of their
// squares.
//
// With the errors a and b of its two replicates a pixel's true error is (a + b)^2 / 4 and its estimate (a - b)^2 / 4,
// both over r^2 + 0.01: they differ by a b, whose variance is four times the square of the pixel's expected error,
// whatever the distribution. The square of an estimate would be too large for that expectation: three times for normal
// replicates, and more for skewed ones. The product with the errors around is not, where these are alike. As far as a
// pixel differs from those around, a third of its square must do. The sum of squares is itself noisy where a few pixels
// carry it: it counts as one standard error larger.
double equal_pixels(const Film& film, const PixelErrors& errors) {
    const int width = film.width(), height = film.height();
    struct Sums {
        double squares = 0, spread = 0;
    };
    std::vector<Sums> rows(static_cast<std::size_t>(height));
    for_each_row(height, [&](int y) {
        Sums& row = rows[static_cast<std::size_t>(y)];
        const auto error_at = [&](int i, int j) { return static_cast<double>(errors.error[film.index(i, j)]); };
        for_each_window(width, height, y, kReach, error_at, [&](int x, double sum, int count) {
            const double error = error_at(x, y), own = count > 1 ? errors.own[film.index(x, y)] : 1;
            const double around = (sum - error) / std::max(1, count - 1);
            const double squared = error * ((1 - own) * around + own * error / 3);
            row.squares += squared, row.spread += square(squared);
        });
    });
    Sums all;
    for (const Sums& row : rows) all.squares += row.squares, all.spread += row.spread;
    // Of n equal pixels the square of the sum is n^2 + 2 n on average.
    return std::clamp(square(errors.sum) / (all.squares + std::sqrt(all.spread)) - 2, 1.0,
                      static_cast<double>(film.pixels()));
}

ErrorEstimate without(const std::string& reason) {
    ErrorEstimate e;
    e.estimate = e.ci95_low = e.ci95_high = kNaN;
    e.reason = reason;
    return e;
}

// More room than that in the interval, as a logarithm, for what the pixels' own noise hides, and there is none. Few
// samples find light in so few of the pixels that have it that they tell little of the others: measured at 8, a fifth
// was needed where two thirds were missing, or where the estimate was three times the error.
double most_hidden(double samples) { return samples < 16 ? 0.2 : 3; }

ErrorEstimate estimate(const Film& film, PixelMaps* maps) {
    if (!film.is_whole()) return without("only some of the picture's pixels are rendered");
    if (film.fewest_samples() < SamplePlan::kFirstPass)
        return without("fewer than " + std::to_string(SamplePlan::kFirstPass) + " samples in a pixel");
    PixelErrors errors = pixel_errors(film);
    if (!std::isfinite(errors.sum)) return without("samples too large for their squares");
    if (errors.not_found + errors.by_noise > most_hidden(film.mean_samples()))
        return without("too much of the noise comes from samples that found light alone in their pixels");
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

// Of F-distributed numbers with n and n degrees of freedom: the variance of the logarithm is twice the trigamma
// function of n / 2, here by the first terms of its asymptotic series.
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

std::int64_t grown(std::int64_t samples, double factor) {
    return std::max(static_cast<std::int64_t>(static_cast<double>(samples) * factor) / kRound * kRound,
                    samples + kRound);
}

// A step is what --error may overshoot by, and each check risks a stop that luck alone brings: see
// docs/measuring.md.
std::int64_t next_milestone(std::int64_t milestone) { return grown(milestone, 1.25); }

// The last one at or before so many samples.
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

// The error falls no faster than with the square of the samples: a milestone that it could not reach the target at is
// not followed by closer checks, others by one every 3 %.
int next_check(int samples, double upper, double target) {
    if (samples < SamplePlan::kFirstPass) return SamplePlan::kFirstPass;
    const std::int64_t milestone = last_milestone(samples), next = next_milestone(milestone);
    if (upper > target * square(static_cast<double>(next) / static_cast<double>(milestone))) return as_samples(next);
    std::int64_t check = milestone;
    while (check <= samples) check = grown(check, 1.03);
    return as_samples(std::min(check, next));
}

// Each round costs every machine a start, so that they are fewer than checks, and their steps as large as the same rule
// allows: 5 % at least, and a factor of 4 at most because the estimate is rough where much is missing.
int next_round(int samples, double upper, double target) {
    const double growth = std::isfinite(upper) ? std::clamp(std::sqrt(upper / target), 1.05, 4.0) : 2;
    return as_samples(grown(std::max(samples, SamplePlan::kFirstPass), growth));
}

}  // namespace limn::transport
