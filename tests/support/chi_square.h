// Pearson's chi-square test of a sampler against its density.
#pragma once

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "limn/math/frame.h"
#include "limn/math/math.h"

namespace limn::test {

inline double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// The p-value each of `tests` tests has to exceed so that all together raise a false alarm with probability 0.01
/// (Sidak, Journal of the American Statistical Association 62, 1967).
inline double sidak_level(int tests) { return 1 - std::pow(1 - 0.01, 1.0 / tests); }

/// Draws from each sampler: ten million in the long form.
inline const int kDraws = std::getenv("LIMN_FULL") ? 10'000'000 : 1'000'000;

/// What the p-value of each of the suite's tests of a sampler has to exceed: of tests/math 10, tests/material 132,
/// tests/render 8, tests/hard 15.
inline const double kSamplerLevel = sidak_level(10 + 132 + 8 + 15);

/// The probability that counts deviate from the expected ones by chance as much as these or more. Cells are pooled
/// until 5 counts are expected, below which the chi-square distribution does not hold (Cochran, Biometrics 10, 1954).
inline double chi_square_p(const std::vector<double>& observed, const std::vector<double>& expected) {
    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
    double statistic = 0, pooled_observed = 0, pooled_expected = 0;
    int cells = 0;
    for (const std::size_t cell : order) {
        pooled_observed += observed[cell];
        pooled_expected += expected[cell];
        if (pooled_expected < 5) continue;
        statistic += (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected;
        pooled_observed = pooled_expected = 0;
        ++cells;
    }
    // What is left at the end comes from empty histograms only: the largest cells come last.
    if (cells < 2 || pooled_observed > 0) return 0;
    return boost::math::gamma_q((cells - 1) / 2.0, statistic / 2);
}

/// Coordinates of [from, to] by t in [0, 1]: even ones, or closer together towards a peak between the ends, as the cube
/// of what t is from 1 / 2.
struct Spacing {
    double from, to, peak;
    bool even;

    double at(double t) const {
        const double s = 2 * t - 1;
        return even ? from + t * (to - from) : peak + s * s * s * reach(s);
    }
    /// The derivative of at().
    double slope(double t) const {
        const double s = 2 * t - 1;
        return even ? to - from : 6 * s * s * reach(s);
    }
    double t_of(double x) const {
        return even ? (x - from) / (to - from) : (1 + std::cbrt((x - peak) / reach(x - peak))) / 2;
    }

private:
    double reach(double s) const { return s < 0 ? peak - from : to - peak; }
};

/// A histogram of directions up to an angle from an axis: rows of x = sin(theta / 2), columns of phi, and one more cell
/// for what was absorbed. Rows and columns are even, or fewer and narrower towards a direction where the density peaks.
class DirectionHistogram {
public:
    /// \param max_angle beyond which there must be no sample
    explicit DirectionHistogram(const Vec3& axis, double max_angle = kPi)
        : DirectionHistogram(axis, max_angle, nullptr) {}
    /// \param peak within the angle, neither on the axis nor on the edge
    DirectionHistogram(const Vec3& axis, double max_angle, const Vec3& peak)
        : DirectionHistogram(axis, max_angle, &peak) {}

    void add(const std::optional<Vec3>& direction) {
        if (!direction) {
            counts_.back() += 1;
            return;
        }
        const Vec3 local = frame_.to_local(*direction);
        const double x = x_of(local);
        // The largest x is rounded, and so is the direction.
        if (x > x_.to * (1 + gamma(64))) outside_ = true;
        const double turn = std::remainder(std::atan2(local.y, local.x) - phi_peak_, 2 * kPi);
        counts_[index(x_.t_of(x), rows_) * columns_ + index(phi_.t_of(turn), columns_)] += 1;
    }

    /// \param pdf per solid angle, of a world direction; what it lacks to 1 is expected to be absorbed
    template <class Pdf>
    double p_value(const Pdf& pdf) const {
        const double samples = std::accumulate(counts_.begin(), counts_.end(), 0.0);
        std::vector<double> expected(counts_.size());
        for (std::size_t cell = 0; cell < cells(); ++cell) expected[cell] = samples * integral(cell, pdf);
        const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
        if (outside_ || total > samples * (1 + quadrature_error())) return 0;
        expected.back() = std::max(0.0, samples - total);
        const bool lossless = expected.back() < samples * quadrature_error() && counts_.back() == 0;
        if (lossless) expected.back() = 0;
        return chi_square_p(counts_, expected);
    }

    /// The integral of a function over all directions up to the largest angle.
    template <class Function>
    double integral(const Function& function) const {
        double sum = 0;
        for (std::size_t cell = 0; cell < cells(); ++cell) sum += integral(cell, function);
        return sum;
    }

    /// Bound on the relative error of integral() of even cells for the densities tested here, continuous within the
    /// largest angle: a fifth of the 1e-3 by which a million counts scatter.
    static constexpr double kQuadratureError = 2e-4;

    /// The same around a peak, where a twentieth of the draws scatter by 4.5e-3.
    double quadrature_error() const { return x_.even ? kQuadratureError : 4 * kQuadratureError; }

private:
    DirectionHistogram(const Vec3& axis, double max_angle, const Vec3* peak)
        : frame_(axis), rows_(peak ? 20 : 60), columns_(peak ? 12 : 24), counts_(rows_ * columns_ + 1) {
        const Vec3 local = peak ? frame_.to_local(*peak) : Vec3{0, 0, 1};
        // Ten million counts show what a rim where a density ends steeply costs 24 midpoints a side of an even cell.
        const bool is_long = kDraws > 1'000'000;
        steps_ = peak ? (is_long ? 60 : 10) : (is_long ? 192 : 24);
        phi_peak_ = peak ? std::atan2(local.y, local.x) : 0;
        x_ = {0, std::sin(max_angle / 2), x_of(local), !peak};
        phi_ = {-kPi, kPi, 0, !peak};
    }

    static double x_of(const Vec3& local) { return length(local - Vec3{0, 0, 1}) / 2; }

    static std::size_t index(double fraction, std::size_t size) {
        return std::min(static_cast<std::size_t>(fraction * static_cast<double>(size)), size - 1);
    }

    std::size_t cells() const { return rows_ * columns_; }

    // cos theta = 1 - 2 x^2, so dw = 4 x dx dphi. By midpoints.
    template <class Function>
    double integral(std::size_t cell, const Function& function) const {
        const double di = 1.0 / static_cast<double>(rows_ * steps_), dj = 1.0 / static_cast<double>(columns_ * steps_);
        double sum = 0;
        for (std::size_t i = 0; i < steps_; ++i) {
            const double row = (static_cast<double>(cell / columns_ * steps_ + i) + 0.5) * di, x = x_.at(row);
            const double sine = 2 * x * std::sqrt(1 - x * x);
            for (std::size_t j = 0; j < steps_; ++j) {
                const double column = (static_cast<double>(cell % columns_ * steps_ + j) + 0.5) * dj;
                const double phi = phi_.at(column) + phi_peak_;
                const Vec3 local{sine * std::cos(phi), sine * std::sin(phi), 1 - 2 * x * x};
                sum += 4 * x * x_.slope(row) * phi_.slope(column) * function(frame_.to_world(local));
            }
        }
        return sum * di * dj;
    }

    Frame frame_;
    std::size_t rows_, columns_, steps_;
    Spacing x_, phi_;
    double phi_peak_;
    std::vector<double> counts_;
    bool outside_ = false;
};

/// The p-value that points are uniform in the unit square. `next` returns one as a pair.
template <class Next>
double uniform_square_p(int samples, const Next& next, std::size_t side = 32) {
    std::vector<double> observed(side * side);
    const auto index = [&](double x) {
        return static_cast<std::size_t>(std::clamp(x * static_cast<double>(side), 0.0, static_cast<double>(side - 1)));
    };
    for (int i = 0; i < samples; ++i) {
        const auto [x, y] = next();
        observed[index(x) * side + index(y)] += 1;
    }
    const double each = samples / static_cast<double>(side * side);
    return chi_square_p(observed, std::vector<double>(side * side, each));
}

}  // namespace limn::test
