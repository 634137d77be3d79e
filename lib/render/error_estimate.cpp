#include "render/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "image/compare_values.h"
#include "render/parallel.h"

namespace limn::tracing {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// Of truth minus estimate, over the square of a pixel's error: 2 for one degree of freedom, 2/3 for three.
constexpr double kVarianceOfDifference = 8.0 / 3;
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

// The three ways to split four replicates into two pairs.
constexpr std::size_t kSplits[3][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}};

// What one pair of replicates says of the variance of the mean of all N samples: unbiased, also for unequal counts.
double variance_by_pair(const Replicates& p, std::size_t a, std::size_t b, std::size_t channel) {
    const double difference = p.means[a][channel] - p.means[b][channel];
    return square(difference) / (p.samples * (1 / p.counts[a] + 1 / p.counts[b]));
}

// r^2 + 0.01 by two replicates. 1 / (r^2 + 0.01) of a noisy r is on average too large; the last term, its second
// derivative times the variance of r, makes up for that where it is convex.
double denominator_by_pair(const Replicates& p, std::size_t a, std::size_t b, std::size_t channel) {
    const double x = p.means[a][channel], y = p.means[b][channel];
    const double squared = square((x + y) / 2), variance = square((x - y) / 2);
    return squared + kDarkness + std::max(0.0, 3 * squared - kDarkness) * variance / (squared + kDarkness);
}

// A pixel's relative error, and an estimate of the square of its expectation, which the square of the first, noisy as
// it is, would exceed.
struct Relative {
    double error = 0, squared = 0;
    Relative& operator+=(const Relative& o) {
        error += o.error, squared += o.squared;
        return *this;
    }
};

// Of the pixel by its pairs, averaged over the splits. The two pairs of a split are independent, so that their product
// has the square of the expectation as its own.
template <class Pair>
Relative by_splits(const Pair& by_pair) {
    Relative r;
    for (const auto& [a, b, c, d] : kSplits) {
        double first = 0, second = 0;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            first += by_pair(a, b, c, d, channel) / 3;
            second += by_pair(c, d, a, b, channel) / 3;
        }
        r += {(first + second) / 6, first * second / 3};
    }
    return r;
}

// With r^2 from the pixel. Where samples are skewed, variance and mean of the same samples are high together, and their
// quotient is too small: fireflies would hide themselves. So one pair of replicates gives the variance, the other r^2,
// which knows nothing of it.
//
// The r^2 of the true error knows all. How far it may lie from that of a pair is told by what the mean of all four
// gives instead: for a firefly much less. The square of that counts among the squares, in the units of add_interval.
Relative relative_by_pixel(const Replicates& p) {
    double with_all = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        double mean = 0, variance = 0;
        for (std::size_t r = 0; r < kReplicates; ++r) mean += p.counts[r] * p.means[r][channel] / p.samples;
        for (const auto& [a, b, c, d] : kSplits)
            variance += (variance_by_pair(p, a, b, channel) + variance_by_pair(p, c, d, channel)) / 6;
        with_all += variance / (square(mean) + kDarkness) / 3;
    }
    Relative relative =
        by_splits([&p](std::size_t a, std::size_t b, std::size_t c, std::size_t d, std::size_t channel) {
            return variance_by_pair(p, a, b, channel) / denominator_by_pair(p, c, d, channel);
        });
    relative.squared += square(relative.error - with_all) / kVarianceOfDifference;
    return relative;
}

// With r^2 from the pixels around.
Relative relative_by_surround(const Replicates& p, const Channels& around) {
    return by_splits([&](std::size_t a, std::size_t b, std::size_t, std::size_t, std::size_t channel) {
        return variance_by_pair(p, a, b, channel) / (square(around[channel]) + kDarkness);
    });
}

// Over pixels. `spread` is the sum of the squares of `squared`: its standard error, squared, or more.
struct Sum {
    double error = 0, squared = 0, spread = 0;
    void add(const Relative& r) { error += r.error, squared += r.squared, spread += square(r.squared); }
    void add(const Sum& o) { error += o.error, squared += o.squared, spread += o.spread; }
};

struct RowSums {
    Sum by_pixel, by_surround;
};

// One pass over all rows in parallel; sums are added up row by row, so that threads do not matter.
class Pass {
public:
    explicit Pass(const Film& film) : film_(film), width_(film.width()), height_(film.height()) {
        means_.resize(film_.pixels());
        for_each_row(height_, [this](int y) {
            for (int x = 0; x < width_; ++x) means_[film_.index(x, y)] = film_.mean(x, y);
        });
    }

    // part(x, y, relative error by the pixel, by its surround) is called for each pixel.
    template <class Part>
    RowSums sums(const Part& part) const {
        std::vector<RowSums> rows(size(height_));
        for_each_row(height_, [&](int y) { rows[size(y)] = row(y, part); });
        RowSums all;
        for (const RowSums& r : rows) {
            all.by_pixel.add(r.by_pixel);
            all.by_surround.add(r.by_surround);
        }
        return all;
    }

private:
    static std::size_t size(int n) { return static_cast<std::size_t>(n); }

    template <class Part>
    RowSums row(int y, const Part& part) const {
        const int top = std::max(0, y - 2), bottom = std::min(height_ - 1, y + 2);
        std::vector<Color> columns(size(width_));
        for (int j = top; j <= bottom; ++j)
            for (int x = 0; x < width_; ++x) columns[size(x)] += means_[film_.index(x, j)];
        RowSums sums;
        for (int x = 0; x < width_; ++x) {
            const int left = std::max(0, x - 2), right = std::min(width_ - 1, x + 2);
            Color surround;
            for (int i = left; i <= right; ++i) surround += columns[size(i)];
            const Channels around = channels(surround / ((right - left + 1) * (bottom - top + 1)));
            const Replicates replicates(film_, x, y);
            const Relative by_pixel = relative_by_pixel(replicates);
            const Relative by_surround = relative_by_surround(replicates, around);
            sums.by_pixel.add(by_pixel);
            sums.by_surround.add(by_surround);
            part(x, y, by_pixel.error, by_surround.error);
        }
        return sums;
    }

    const Film& film_;
    const int width_, height_;
    std::vector<Color> means_;
};

double pixels(const Film& film) { return static_cast<double>(film.pixels()); }

double max_sample_share(const Film& film) {
    std::vector<double> shares;
    shares.reserve(film.pixels());
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
// a pixel, whose channels go together at worst, where the estimate from four replicates has 3. For n pixels of equal
// error and normal replicates the quotient of both is F-distributed with n and 3 n degrees. The variance of truth minus
// estimate is 8/3 of the sum of the squared errors that the pixels have in the mean, for whatever distribution: fourth
// cumulants move both alike and cancel. So n is the square of the sum of e over the sum of squares; of the former, the
// part that the estimate's own variance of 2/3 adds is taken off. The sum of squares is itself noisy where a few pixels
// carry it: it counts as one standard error larger.
void add_interval(ErrorEstimate& e, const Sum& sum, double count) {
    e.estimate = sum.error / count;
    if (!(sum.error > 0)) return;
    const double values = std::clamp(square(sum.error) / (sum.squared + std::sqrt(sum.spread)) - 2.0 / 3, 1.0, count);
    const ErrorFactors factors = error_factors(values);
    e.ci95_low = factors.low * e.estimate;
    e.ci95_high = factors.high * e.estimate;
}

bool pixel_counts(const RowSums& sums) { return sums.by_pixel.error >= sums.by_surround.error; }

void add_larger(ErrorEstimate& e, const RowSums& s, double count) {
    add_interval(e, pixel_counts(s) ? s.by_pixel : s.by_surround, count);
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
    const std::size_t count = film.pixels();
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
        const std::size_t i = film.index(x, y);
        by_pixel[i] = static_cast<float>(here);
        by_surround[i] = static_cast<float>(around);
    });
    add_larger(e, sums, pixels(film));
    if (maps) maps->error = std::move(pixel_counts(sums) ? by_pixel : by_surround);
    return e;
}

// Steps of 3 % near the target. Further away one may jump to where the error would be if it fell with the square of the
// samples: faster than any picture's does, so that the target is not jumped over, and never by more than a quarter.
int next_check(int samples, double upper, double target) {
    constexpr double kSmallestGrowth = 1.03, kLargestGrowth = 1.25;
    const double growth = std::clamp(std::sqrt(upper / target), kSmallestGrowth, kLargestGrowth);
    const double next = std::min(samples * growth, static_cast<double>(std::numeric_limits<int>::max() - kReplicates));
    return std::max(static_cast<int>(next) / kReplicates * kReplicates, samples + kReplicates);
}

}  // namespace limn::tracing
