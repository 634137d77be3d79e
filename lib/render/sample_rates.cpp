#include "render/sample_rates.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "image/compare_values.h"
#include "math/parallel.h"

namespace limn::transport {

namespace {

constexpr int kReach = 2;  // pixels to each side in the window whose variance is averaged
// The weight of relative_unseen. It would be 1 for independent samples. The samples are Sobol points, which cover edges
// much better than independent ones. A larger weight would spend samples on edges that are needed elsewhere.
constexpr double kUnseen = 0.08;

// Returns the relative variance that a pixel's mean would have if its samples were independent. The variance of the
// film's Sobol points is usually smaller and would be the right one. But its estimate from two replicates is so noisy
// that rates computed from it gave noisier pictures.
double relative_variance(const Film& film, int x, int y) {
    const Color mean = film.mean(x, y), variance = film.independent_variance(x, y);
    const auto relative = [](double v, double m) { return v / (m * m + kDarkness); };
    return relative(variance.r, mean.r) + relative(variance.g, mean.g) + relative(variance.b, mean.b);
}

// Returns the relative variance that the samples of pixel (x, y) may have missed. It assumes that one more sample could
// have had the value of any of the pixels around (the rule of succession: Laplace, Memoire sur la probabilite des
// causes par les evenements, 1774). For example, a lamp that covers a hundredth of a pixel is usually missed by all its
// samples. The pixel seems dark and free of noise. The pixels around it, which the lamp covers wholly or not at all,
// are free of noise too, but their contrast is large.
double relative_unseen(const Film& film, int x, int y) {
    // Sum the means of the eight pixels around, their squares, and the inverses of the squares.
    double count = 0;
    Color sum, squares, inverses;
    for (int j = std::max(0, y - 1); j <= std::min(film.height() - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(film.width() - 1, x + 1); ++i) {
            if (i == x && j == y) continue;
            const Color mean = film.mean(i, j), square = mean * mean;
            const auto inverse = [](double v) { return 1 / (v + kDarkness); };
            count += 1;
            sum += mean;
            squares += square;
            inverses += Color{inverse(square.r), inverse(square.g), inverse(square.b)};
        }
    if (count < 2) return 0;
    // Compute the missed variance. A sample has one of these values with probability 1 / (n + 1), and the mean of n
    // samples has 1 / n of a sample's variance. Divide it by the squared mean of each of these pixels, and average.
    constexpr int n = SamplePlan::kFirstPass;
    const Color variance = (squares - sum * sum / count) / ((count - 1) * (n + 1) * n);
    const auto relative = [count](double v, double inverse) { return std::max(0.0, v) * inverse / count; };
    return relative(variance.r, inverses.r) + relative(variance.g, inverses.g) + relative(variance.b, inverses.b);
}

}  // namespace

std::vector<float> sample_rates(const Film& film) {
    const int width = film.width(), height = film.height();
    // Compute the relative variance of each pixel.
    std::vector<float> variances(film.pixels()), rates(film.places());
    for_each_row(height, [&](int y) {
        for (int x = 0; x < width; ++x) variances[film.index(x, y)] = static_cast<float>(relative_variance(film, x, y));
    });

    // Compute the relative standard deviation of each pixel from the pixels around it, and the sum of each row. Sums by
    // row make the rounding independent of the threads.
    std::vector<double> sums(static_cast<std::size_t>(height));
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

    // Divide by the mean and clamp. All rates are 1 if there is no noise or a value is beyond float.
    double mean = 0;
    for (const double sum : sums) mean += sum;
    mean /= static_cast<double>(film.pixels());
    const bool usable = mean > 0 && std::isfinite(mean);
    for (float& rate : rates)
        rate = usable ? std::min(kSmallestRate + (1 - kSmallestRate) * static_cast<float>(rate / mean), kLargestRate)
                      : 1.0f;
    return rates;
}

// Uses regula falsi, because the sum of samples grows almost in proportion to the scale. Each step removes at least 1 %
// of the interval.
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
    // Double the scale until its sum exceeds the target.
    double low = 0, sum_low = pixels * SamplePlan::kFirstPass, high = samples, sum_high = sum_at(high);
    for (; sum_high <= target && high < 0x1p40; sum_high = sum_at(high)) {
        low = high;
        sum_low = sum_high;
        high *= 2;
    }
    // Narrow the interval. The sum at its lower end never exceeds the target.
    for (int i = 0; i < 64 && target - sum_low > near_enough; ++i) {
        const double by_line = (target - sum_low) / std::max(1.0, sum_high - sum_low);
        const double scale = low + (high - low) * std::clamp(by_line, 0.01, 0.99), sum = sum_at(scale);
        if (sum <= target) {
            low = scale;
            sum_low = sum;
        } else {
            high = scale;
            sum_high = sum;
        }
    }
    return low;
}

}  // namespace limn::transport
