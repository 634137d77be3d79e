#include "render/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "render/parallel.h"

namespace limn::tracing {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kDarkness = 0.01;  // of the error metric: design of relMSE, see image/compare.h
constexpr double kNormal975 = 1.959963984540054;

using Channels = std::array<double, 3>;
Channels channels(const Color& c) { return {c.r, c.g, c.b}; }
double square(double x) { return x * x; }

// The replicates of one pixel: their means, and over how many samples each.
struct Replicates {
    Replicates(const Film& film, int x, int y) : samples(film.samples(x, y)) {
        for (std::uint32_t r = 0; r < kReplicates; ++r) {
            counts[r] = film.replicate_samples(x, y, r);
            means[r] = channels(film.replicate_mean(x, y, r));
        }
    }
    double samples;
    std::array<double, kReplicates> counts;
    std::array<Channels, kReplicates> means;
};

// The variance of the mean of all N samples: sum of n_r (replicate mean - mean)^2 / ((R - 1) N), unbiased for unequal
// n_r too.
double variance_of_mean(const Replicates& p, double mean, std::size_t channel) {
    double sum = 0;
    for (std::size_t r = 0; r < kReplicates; ++r) sum += p.counts[r] * square(p.means[r][channel] - mean);
    return sum / ((kReplicates - 1) * p.samples);
}

// That variance over r^2 + 0.01, with r^2 from the pixel. Where samples are skewed, variance and mean of the same
// samples are high together, and their quotient is too small: fireflies would hide themselves. So each pair of
// replicates gives a variance, the other two give r^2, which knows nothing of it, and the six ways to choose are
// averaged. 1 / (r^2 + 0.01) of a noisy r is on average too large, by no more than a factor of
// 1 + 3 (variance of r) / (r^2 + 0.01) in the first order: hence the last term.
double relative_by_pixel(const Replicates& p, std::size_t channel) {
    constexpr std::size_t kPairs[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2},
                                          {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};
    double sum = 0;
    for (const auto& [a, b, c, d] : kPairs) {
        const auto mean = [&](std::size_t r) { return p.means[r][channel]; };
        const double variance = square(mean(a) - mean(b)) / (p.samples * (1 / p.counts[a] + 1 / p.counts[b]));
        const double here = (mean(c) + mean(d)) / 2, variance_here = square((mean(c) - mean(d)) / 2);
        sum += variance / (square(here) + kDarkness + 3 * variance_here);
    }
    return sum / 6;
}

struct RowSums {
    double by_pixel = 0, by_pixel_squared = 0, by_surround = 0, by_surround_squared = 0;
    RowSums& operator+=(const RowSums& o) {
        by_pixel += o.by_pixel, by_pixel_squared += o.by_pixel_squared;
        by_surround += o.by_surround, by_surround_squared += o.by_surround_squared;
        return *this;
    }
};

// One pass over all rows in parallel; sums are added up row by row, so that threads do not matter.
class Pass {
public:
    explicit Pass(const Film& film) : film_(film), width_(film.width()), height_(film.height()) {
        means_.resize(size(width_) * size(height_));
        for_each_row([this](int y) {
            for (int x = 0; x < width_; ++x) means_[at(x, y)] = film_.mean(x, y);
        });
    }

    // part(x, y, relative error by the pixel, by its surround) is called for each pixel.
    template <class Part>
    RowSums sums(const Part& part) const {
        std::vector<RowSums> rows(size(height_));
        for_each_row([&](int y) { rows[size(y)] = row(y, part); });
        RowSums all;
        for (const RowSums& r : rows) all += r;
        return all;
    }

private:
    static std::size_t size(int n) { return static_cast<std::size_t>(n); }
    std::size_t at(int x, int y) const { return size(y) * size(width_) + size(x); }

    template <class Function>
    void for_each_row(const Function& function) const {
        // Of its own: a render that was cancelled still wants to know its error.
        tbb::task_group_context context(tbb::task_group_context::isolated);
        for_each_index(size(height_), context, [&](std::size_t y) { function(static_cast<int>(y)); });
    }

    template <class Part>
    RowSums row(int y, const Part& part) const {
        const int top = std::max(0, y - 2), bottom = std::min(height_ - 1, y + 2);
        std::vector<Color> columns(size(width_));
        for (int j = top; j <= bottom; ++j)
            for (int x = 0; x < width_; ++x) columns[size(x)] += means_[at(x, j)];
        RowSums sums;
        for (int x = 0; x < width_; ++x) {
            const int left = std::max(0, x - 2), right = std::min(width_ - 1, x + 2);
            Color surround;
            for (int i = left; i <= right; ++i) surround += columns[size(i)];
            const Channels around = channels(surround / ((right - left + 1) * (bottom - top + 1)));
            const Channels here = channels(means_[at(x, y)]);
            const Replicates replicates(film_, x, y);
            double by_pixel = 0, by_surround = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                by_pixel += relative_by_pixel(replicates, c) / 3;
                by_surround += variance_of_mean(replicates, here[c], c) / (square(around[c]) + kDarkness) / 3;
            }
            sums += {by_pixel, square(by_pixel), by_surround, square(by_surround)};
            part(x, y, by_pixel, by_surround);
        }
        return sums;
    }

    const Film& film_;
    const int width_, height_;
    std::vector<Color> means_;
};

double pixels(const Film& film) { return static_cast<double>(film.width()) * film.height(); }

double max_sample_share(const Film& film) {
    std::vector<double> shares;
    shares.reserve(static_cast<std::size_t>(pixels(film)));
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) shares.push_back(film.largest_share(x, y));
    const auto rank = static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(shares.size() - 1));
    std::nth_element(shares.begin(), shares.begin() + rank, shares.end());
    return shares[static_cast<std::size_t>(rank)];
}

bool can_estimate(const Film& film, ErrorEstimate& e) {
    if (film.fewest_samples() >= kReplicates) return true;
    e.estimate = e.ci95_low = e.ci95_high = kNaN;
    e.reason = "fewer than " + std::to_string(kReplicates) + " samples in a pixel";
    return false;
}

// The interval is of the true error of this very picture, which is itself a sum of random squares: 1 degree of freedom
// a pixel, whose channels go together at worst, where the estimate from four replicates has 3. For normal replicate
// means of n pixels with equal error the quotient of both is F-distributed with n and 3 n degrees. For unequal ones
// n is (sum e)^2 / sum e^2, from the spread over pixels: with E[e_p^2] = 5/3 of the square of its expectation, both
// sums are freed of what the noise of e itself adds. (Pixels with heavier tails have larger squares, so that n
// falls; while the fourth moment, which moves truth and estimate alike, falls out of their difference.)
void add_interval(ErrorEstimate& e, double sum, double sum_of_squares, double count) {
    e.estimate = sum / count;
    if (!(sum > 0)) return;
    const double values = (sum * sum - 0.4 * sum_of_squares) / (0.6 * sum_of_squares);
    const ErrorFactors factors = error_factors(values);
    e.ci95_low = factors.low * e.estimate;
    e.ci95_high = factors.high * e.estimate;
}

bool pixel_counts(const RowSums& sums) { return sums.by_pixel >= sums.by_surround; }

void add_larger(ErrorEstimate& e, const RowSums& s, double count) {
    if (pixel_counts(s))
        add_interval(e, s.by_pixel, s.by_pixel_squared, count);
    else
        add_interval(e, s.by_surround, s.by_surround_squared, count);
}

}  // namespace

// Paulson, An approximate normalization of the analysis of variance distribution, 1942: the cube root w of an
// F-distributed number makes ((1 - b) w - (1 - a)) / sqrt(b w^2 + a) nearly normal, a = 2 / (9 n), b = 2 / (9 m).
// Solved for w at the normal quantiles. At n = 1, where it is worst, `high` comes out as 19.2 instead of 17.4.
ErrorFactors error_factors(double values) {
    const double a = 2 / (9 * values), b = 2 / (9 * (kReplicates - 1) * values), z2 = square(kNormal975);
    const double p = square(1 - b) - z2 * b, q = (1 - a) * (1 - b), r = square(1 - a) - z2 * a;
    const double root = std::sqrt(q * q - p * r);
    const double low = std::max(0.0, (q - root) / p), high = (q + root) / p;
    return {low * low * low, high * high * high};
}

ErrorEstimate check_error(const Film& film) {
    ErrorEstimate e;
    if (can_estimate(film, e)) add_larger(e, Pass(film).sums([](int, int, double, double) {}), pixels(film));
    return e;
}

ErrorEstimate estimate_error(const Film& film, PixelMaps* maps) {
    ErrorEstimate e;
    e.max_sample_share = max_sample_share(film);
    const auto count = static_cast<std::size_t>(pixels(film));
    if (maps) {
        maps->samples.clear();
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x) maps->samples.push_back(static_cast<float>(film.samples(x, y)));
        maps->error.clear();
    }
    if (!can_estimate(film, e)) return e;
    std::vector<float> by_pixel(maps ? count : 0), by_surround(maps ? count : 0);
    const RowSums sums = Pass(film).sums([&](int x, int y, double here, double around) {
        if (!maps) return;
        const auto i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(film.width()) + static_cast<std::size_t>(x);
        by_pixel[i] = static_cast<float>(here);
        by_surround[i] = static_cast<float>(around);
    });
    add_larger(e, sums, pixels(film));
    if (maps) maps->error = std::move(pixel_counts(sums) ? by_pixel : by_surround);
    return e;
}

// Steps of 6 % near the target. Further away one may jump to where the error would be if it fell with the square of the
// samples: faster than any picture's does, so that the target is not jumped over, and never beyond half as many again.
int next_check(int samples, double upper, double target) {
    constexpr double kSmallestGrowth = 1.06, kLargestGrowth = 1.5;
    const double growth = std::clamp(std::sqrt(upper / target), kSmallestGrowth, kLargestGrowth);
    const double next = std::min(samples * growth, static_cast<double>(std::numeric_limits<int>::max() - kReplicates));
    return std::max(static_cast<int>(next) / kReplicates * kReplicates, samples + kReplicates);
}

}  // namespace limn::tracing
