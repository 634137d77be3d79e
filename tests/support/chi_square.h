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

#include "limn/core/frame.h"
#include "limn/core/math.h"

namespace limn::test {

inline double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// The p-value each of `tests` tests has to exceed so that all together raise a false alarm with probability 0.01
/// (Sidak, Journal of the American Statistical Association 62, 1967).
inline double sidak_level(int tests) { return 1 - std::pow(1 - 0.01, 1.0 / tests); }

/// Draws from each sampler: ten million in the long form.
inline const int kDraws = std::getenv("LIMN_FULL") ? 10'000'000 : 1'000'000;

/// What the p-value of each of the suite's tests of a sampler has to exceed: of tests/core 10, tests/material 54,
/// tests/render 8, tests/hard 15.
inline const double kSamplerLevel = sidak_level(10 + 54 + 8 + 15);

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

/// A histogram of directions up to an angle from an axis: rows uniform in x = sin(theta / 2), columns uniform in phi,
/// and one more cell for what was absorbed.
class DirectionHistogram {
public:
    /// \param max_angle beyond which there must be no sample
    explicit DirectionHistogram(const Vec3& axis, double max_angle = kPi)
        : frame_(axis), x_max_(std::sin(max_angle / 2)), counts_(kRows * kColumns + 1) {}

    void add(const std::optional<Vec3>& direction) {
        if (!direction) {
            counts_[kAbsorbed] += 1;
            return;
        }
        const Vec3 local = frame_.to_local(*direction);
        const double x = length(local - Vec3{0, 0, 1}) / 2;
        // The largest x is rounded, and so is the direction.
        if (x > x_max_ * (1 + gamma(64))) outside_ = true;
        const double turn = (std::atan2(local.y, local.x) + kPi) / (2 * kPi);
        counts_[index(x / x_max_, kRows) * kColumns + index(turn, kColumns)] += 1;
    }

    /// \param pdf per solid angle, of a world direction; what it lacks to 1 is expected to be absorbed
    template <class Pdf>
    double p_value(const Pdf& pdf) const {
        const double samples = std::accumulate(counts_.begin(), counts_.end(), 0.0);
        std::vector<double> expected(counts_.size());
        for (std::size_t cell = 0; cell < kAbsorbed; ++cell) expected[cell] = samples * integral(cell, pdf);
        const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
        if (outside_ || total > samples * (1 + kQuadratureError)) return 0;
        expected[kAbsorbed] = std::max(0.0, samples - total);
        const bool lossless = expected[kAbsorbed] < samples * kQuadratureError && counts_[kAbsorbed] == 0;
        if (lossless) expected[kAbsorbed] = 0;
        return chi_square_p(counts_, expected);
    }

    /// The integral of a function over all directions up to the largest angle.
    template <class Function>
    double integral(const Function& function) const {
        double sum = 0;
        for (std::size_t cell = 0; cell < kAbsorbed; ++cell) sum += integral(cell, function);
        return sum;
    }

    /// Bound on the relative error of integral() for the densities tested here, continuous within the largest angle:
    /// a fifth of the 1e-3 by which a million counts scatter.
    static constexpr double kQuadratureError = 2e-4;

private:
    static constexpr std::size_t kRows = 60, kColumns = 24, kAbsorbed = kRows * kColumns;
    // Midpoints along each side of a cell. Ten million counts show what a rim where a density ends steeply costs 24.
    static inline const std::size_t kSteps = kDraws > 1'000'000 ? 192 : 24;

    static std::size_t index(double fraction, std::size_t size) {
        return std::min(static_cast<std::size_t>(fraction * static_cast<double>(size)), size - 1);
    }

    // cos theta = 1 - 2 x^2, so dw = 4 x dx dphi.
    template <class Function>
    double integral(std::size_t cell, const Function& function) const {
        const double dx = x_max_ / static_cast<double>(kRows * kSteps);
        const double dphi = 2 * kPi / static_cast<double>(kColumns * kSteps);
        double sum = 0;
        for (std::size_t i = 0; i < kSteps; ++i) {
            const double x = (static_cast<double>(cell / kColumns * kSteps + i) + 0.5) * dx;
            const double sine = 2 * x * std::sqrt(1 - x * x);
            for (std::size_t j = 0; j < kSteps; ++j) {
                const double phi = (static_cast<double>(cell % kColumns * kSteps + j) + 0.5) * dphi - kPi;
                const Vec3 local{sine * std::cos(phi), sine * std::sin(phi), 1 - 2 * x * x};
                sum += 4 * x * function(frame_.to_world(local));
            }
        }
        return sum * dx * dphi;
    }

    Frame frame_;
    double x_max_;
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
