#include "render/pixel_errors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "image/compare_values.h"
#include "math/elementary.h"
#include "math/parallel.h"
#include "render/window.h"

namespace limn::transport {

namespace {

constexpr int kEvennessReach = 3;  // pixels to each side in the window of evenness()
// A sample with a larger share of its pixel than this has found light that the pixel's other samples missed.
constexpr double kSingle = 0.5;

using Channels = std::array<double, 3>;
Channels channels(const Color& c) { return {c.r, c.g, c.b}; }
double square(double x) { return x * x; }
std::size_t size(int n) { return static_cast<std::size_t>(n); }

// Variances of the mean of a pixel, Film::variance and Film::independent_variance, summed over the channels.
struct Variances {
    double by_replicates = 0, if_independent = 0;
    Variances& operator+=(const Variances& o) {
        by_replicates += o.by_replicates;
        if_independent += o.if_independent;
        return *this;
    }
};

// Returns a factor for each pixel, at most 1: by how much the film's samples reduce the variance compared with
// independent samples. It is the ratio of the sums of Film::variance and Film::independent_variance over the 7x7 pixels
// around the pixel.
std::vector<float> evenness(const Film& film) {
    const int width = film.width(), height = film.height();
    const auto sum = [](const Color& c) { return c.r + c.g + c.b; };
    std::vector<Variances> variances(film.pixels());
    for_each_row(height, [&](int y) {
        for (int x = 0; x < width; ++x)
            variances[film.index(x, y)] = {sum(film.variance(x, y)), sum(film.independent_variance(x, y))};
    });
    std::vector<float> ratios(film.pixels());
    for_each_row(height, [&](int y) {
        const auto variances_at = [&](int i, int j) { return variances[film.index(i, j)]; };
        for_each_window(width, height, y, kEvennessReach, variances_at, [&](int x, const Variances& around, int) {
            ratios[film.index(x, y)] = around.if_independent > around.by_replicates
                                           ? static_cast<float>(around.by_replicates / around.if_independent)
                                           : 1.0f;
        });
    });
    return ratios;
}

// One channel of a pixel, or the sums of several pixels.
struct Moments {
    double value = 0;    // the mean of the samples
    double squared = 0;  // the square of `value`
    double noise = 0;    // the estimated variance of `value`
    Moments& operator+=(const Moments& o) {
        value += o.value;
        squared += o.squared;
        noise += o.noise;
        return *this;
    }
};
struct PixelMoments {
    std::array<Moments, 3> channels;
    PixelMoments& operator+=(const PixelMoments& o) {
        for (std::size_t c = 0; c < 3; ++c) channels[c] += o.channels[c];
        return *this;
    }
};

// The estimate of a pixel's true value r in one channel.
struct TrueValue {
    double squared;  // the estimate of r^2
    double value;    // the estimate of r
    double own;      // the weight of the pixel's own mean in it
};

// Estimates r and r^2 of a pixel. `around` is the sum over the window of `count` pixels, which contains the pixel.
// `share` is the largest share that one sample has of the pixel. If r has a posterior distribution, the mean of r^2 is
// the squared mean plus the variance. The estimate of r^2 adds `share` times that variance.
TrueValue true_value(const Moments& here, const Moments& around, int count, double share) {
    if (count == 1) return {square(here.value), here.value, 1};
    const double others = (around.value - here.value) / (count - 1);
    const double spread = (around.squared - square(around.value) / count) / (count - 1);
    const double structure = std::max(0.0, spread - around.noise / count);
    const double own = structure + here.noise > 0 ? structure / (structure + here.noise) : 1;
    const double value = others + own * (here.value - others);
    return {square(value) + share * own * here.noise, value, own};
}

// The numbers of PixelErrors, not yet divided by the error.
struct Sums {
    double error = 0, by_noise = 0, by_surround = 0, not_found = 0;
    Sums& operator+=(const Sums& o) {
        error += o.error;
        by_noise += o.by_noise;
        by_surround += o.by_surround;
        not_found += o.not_found;
        return *this;
    }
};

// Estimates the errors row by row. Several threads may work on different rows.
class Rows {
public:
    Rows(const Film& film, const std::vector<float>& evenness, PixelErrors& errors)
        : film_(film), evenness_(evenness), errors_(errors) {}

    // Sets PixelErrors::error and own of row y, and returns the sums over the row.
    Sums row(int y) const {
        Sums sums;
        for_each_window(
            film_.width(), film_.height(), y, 1, [this](int i, int j) { return moments(i, j); },
            [&](int x, const PixelMoments& around, int count) { sums += pixel(x, y, around, count); });
        return sums;
    }

private:
    PixelMoments moments(int x, int y) const {
        const Channels means = channels(film_.mean(x, y)), independent = channels(film_.independent_variance(x, y));
        PixelMoments m;
        for (std::size_t c = 0; c < 3; ++c)
            m.channels[c] = {means[c], square(means[c]), evenness_[film_.index(x, y)] * independent[c]};
        return m;
    }

    Sums pixel(int x, int y, const PixelMoments& around, int count) const {
        const PixelMoments here = moments(x, y);
        const Channels variance = channels(film_.variance(x, y));
        const Channels independent = channels(film_.independent_variance(x, y));
        const double share = film_.largest_share(x, y);
        Sums sums;
        double own = 0, mean = 0;
        // Add a third of the error of each channel.
        for (std::size_t c = 0; c < 3; ++c) {
            const TrueValue r = true_value(here.channels[c], around.channels[c], count, share);
            const double error = variance[c] / (r.squared + kDarkness) / 3, noise = r.own * independent[c];
            const double by_itself = variance[c] / (square(here.channels[c].value) + kDarkness) / 3;
            sums += {error, error * noise / (square(r.value) + noise + kDarkness),
                     r.own * std::max(0.0, error - by_itself), 0};
            own += r.own / 3;
            mean += here.channels[c].value / 3;
        }
        // Add the error due to light that no sample has found. It is error * own in each e-fold of the probability of
        // finding the light (pixel_errors.h), and there are log(mean / 0.1) e-folds.
        if (share > kSingle && square(mean) > kDarkness)
            sums.not_found = sums.error * own * logarithm(square(mean) / kDarkness) / 2;
        errors_.error[film_.index(x, y)] = static_cast<float>(sums.error);
        errors_.own[film_.index(x, y)] = static_cast<float>(own);
        return sums;
    }

    const Film& film_;
    const std::vector<float>& evenness_;
    PixelErrors& errors_;
};

}  // namespace

PixelErrors pixel_errors(const Film& film) {
    const std::vector<float> even = evenness(film);
    PixelErrors errors;
    errors.error.resize(film.pixels());
    errors.own.resize(film.pixels());
    std::vector<Sums> rows(size(film.height()));
    const Rows worker(film, even, errors);
    for_each_row(film.height(), [&](int y) { rows[size(y)] = worker.row(y); });
    // Add the rows in order, so that the rounding does not depend on the threads.
    Sums all;
    for (const Sums& row : rows) all += row;
    errors.sum = all.error;
    if (all.error > 0) {
        errors.by_noise = all.by_noise / all.error;
        errors.by_surround = all.by_surround / all.error;
        errors.not_found = all.not_found / all.error;
    }
    return errors;
}

}  // namespace limn::transport
