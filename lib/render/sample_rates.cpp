#include "render/sample_rates.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "image/compare_values.h"
#include "render/parallel.h"

namespace limn::transport {

namespace {

constexpr int kReach = 2;  // pixels to each side that tell how noisy the one between is
// Of what may be unseen. Independent samples would need all of it; even ones cover edges so much better that more than
// this takes samples from where they are needed (docs/measuring.md).
constexpr double kUnseen = 0.08;

// By the variance that independent samples would have. That of the film's points is mostly smaller and what counts, but
// two replicates tell it so badly that rates from it gave more noise.
double relative_variance(const Film& film, int x, int y) {
    const Color mean = film.mean(x, y), variance = film.independent_variance(x, y);
    const auto relative = [](double v, double m) { return v / (m * m + kDarkness); };
    return relative(variance.r, mean.r) + relative(variance.g, mean.g) + relative(variance.b, mean.b);
}

// The relative variance that the samples of pixel (x, y) may have missed: one more might have been like any of the
// pixels around it (the rule of succession: Laplace, Memoire sur la probabilite des causes par les evenements, 1774). A
// pixel that a lamp covers by a hundredth looks dark and free of noise, and so may those around it, which it covers
// wholly or not at all.
double relative_unseen(const Film& film, int x, int y) {
    double count = 0;
    Color sum, squares, inverses;
    for (int j = std::max(0, y - 1); j <= std::min(film.height() - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(film.width() - 1, x + 1); ++i) {
            if (i == x && j == y) continue;
            const Color mean = film.mean(i, j), square = mean * mean;
            const auto inverse = [](double v) { return 1 / (v + kDarkness); };
            count += 1, sum += mean, squares += square;
            inverses += Color{inverse(square.r), inverse(square.g), inverse(square.b)};
        }
    if (count < 2) return 0;
    constexpr int n = SamplePlan::kFirstPass;
    const Color variance = (squares - sum * sum / count) / ((count - 1) * (n + 1) * n);
    const auto relative = [count](double v, double inverse) { return std::max(0.0, v) * inverse / count; };
    return relative(variance.r, inverses.r) + relative(variance.g, inverses.g) + relative(variance.b, inverses.b);
}

}  // namespace

std::vector<float> sample_rates(const Film& film) {
    const int width = film.width(), height = film.height();
    std::vector<float> variances(film.pixels()), rates(film.places());
    for_each_row(height, [&](int y) {
        for (int x = 0; x < width; ++x) variances[film.index(x, y)] = static_cast<float>(relative_variance(film, x, y));
    });

    std::vector<double> sums(static_cast<std::size_t>(height));  // by row: threads do not change the rounding
    for_each_row(height, [&](int y) {
        const int top = std::max(0, y - kReach), bottom = std::min(height - 1, y + kReach);
        for (int x = 0; x < width; ++x) {
            const int left = std::max(0, x - kReach), right = std::min(width - 1, x + kReach);
            double around = 0;
            for (int j = top; j <= bottom; ++j)
                for (int i = left; i <= right; ++i)
                    if (i != x || j != y) around += variances[film.index(i, j)];
            const int pixels = (right - left + 1) * (bottom - top + 1) - 1;
            const double deviation = std::sqrt(around / std::max(1, pixels) + kUnseen * relative_unseen(film, x, y));
            rates[film.place(x, y)] = static_cast<float>(deviation);
            sums[static_cast<std::size_t>(y)] += deviation;
        }
    });

    double mean = 0;
    for (const double sum : sums) mean += sum;
    mean /= static_cast<double>(film.pixels());
    const bool usable = mean > 0 && std::isfinite(mean);  // no noise, or values beyond float: all alike
    for (float& rate : rates)
        rate = usable ? std::min(kSmallestRate + (1 - kSmallestRate) * static_cast<float>(rate / mean), kLargestRate)
                      : 1.0f;
    return rates;
}

// By regula falsi with a share of bisection: the sum of samples grows with the scale, nearly in proportion.
double scale_for(const Film& film, std::span<const float> rates, int samples, bool exact) {
    std::vector<std::uint64_t> sums(static_cast<std::size_t>(film.height()));
    const auto sum_at = [&](double scale) {
        for_each_row(film.height(), [&](int y) {
            std::uint64_t sum = 0;
            for (int x = 0; x < film.width(); ++x) sum += SamplePlan::wanted(x, y, rates[film.place(x, y)], scale);
            sums[static_cast<std::size_t>(y)] = sum;
        });
        return static_cast<double>(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0}));
    };
    const double pixels = static_cast<double>(film.pixels()), target = pixels * samples;
    const double near_enough = exact ? 1 : std::max(1.0, pixels / 65536);
    double low = 0, sum_low = pixels * SamplePlan::kFirstPass, high = samples, sum_high = sum_at(high);
    for (; sum_high <= target && high < 0x1p40; sum_high = sum_at(high)) low = high, sum_low = sum_high, high *= 2;
    for (int i = 0; i < 64 && target - sum_low > near_enough; ++i) {
        const double by_line = (target - sum_low) / std::max(1.0, sum_high - sum_low);
        const double scale = low + (high - low) * std::clamp(by_line, 0.01, 0.99), sum = sum_at(scale);
        if (sum <= target)
            low = scale, sum_low = sum;
        else
            high = scale, sum_high = sum;
    }
    return low;
}

}  // namespace limn::transport
