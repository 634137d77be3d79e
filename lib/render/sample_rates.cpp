#include "render/sample_rates.h"

#include <algorithm>
#include <cmath>

#include "image/compare_values.h"
#include "render/parallel.h"

namespace limn::tracing {

namespace {

constexpr int kReach = 2;  // pixels to each side that tell how noisy the one between is

// By the variance that independent samples would have. That of the film's points is mostly smaller and what counts, but
// two replicates tell it so badly that rates from it gave more noise.
double relative_variance(const Film& film, int x, int y) {
    const Color mean = film.mean(x, y), variance = film.independent_variance(x, y);
    const auto relative = [](double v, double m) { return v / (m * m + kDarkness); };
    return relative(variance.r, mean.r) + relative(variance.g, mean.g) + relative(variance.b, mean.b);
}

}  // namespace

std::vector<float> sample_rates(const Film& film) {
    const int width = film.width(), height = film.height();
    std::vector<float> variances(film.pixels()), rates(film.pixels());
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
            const double deviation = std::sqrt(around / std::max(1, pixels));
            rates[film.index(x, y)] = static_cast<float>(deviation);
            sums[static_cast<std::size_t>(y)] += deviation;
        }
    });

    double mean = 0;
    for (const double sum : sums) mean += sum;
    mean /= static_cast<double>(rates.size());
    const bool usable = mean > 0 && std::isfinite(mean);  // no noise, or values beyond float: all alike
    for (float& rate : rates)
        rate = usable ? std::min(kSmallestRate + (1 - kSmallestRate) * static_cast<float>(rate / mean), kLargestRate)
                      : 1.0f;
    return rates;
}

std::vector<std::uint32_t> plan_samples(const Film& film, std::span<const float> rates, int target) {
    std::vector<std::uint32_t> plan(rates.size());
    std::uint64_t left = rates.size() * static_cast<std::uint64_t>(target);
    double needed = 0;
    const auto need = [&](std::size_t i) { return std::max(0.0, rates[i] * static_cast<double>(target) - plan[i]); };
    for (std::size_t i = 0, width = static_cast<std::size_t>(film.width()); i < plan.size(); ++i) {
        plan[i] = film.samples(static_cast<int>(i % width), static_cast<int>(i / width));
        left -= plan[i];
        needed += need(i);
    }
    // Pixels that have more than their share leave less for the others. What a pixel lacks to a whole round goes to the
    // next.
    const double share = needed > 0 ? static_cast<double>(left) / needed : 0;
    double carried = 0;
    for (std::size_t i = 0; i < plan.size(); ++i) {
        carried += share * need(i);
        const auto rounds = std::min(static_cast<std::uint64_t>(carried / kReplicates), left / kReplicates);
        plan[i] += static_cast<std::uint32_t>(rounds * kReplicates);
        carried -= static_cast<double>(rounds * kReplicates);
        left -= rounds * kReplicates;
    }
    if (!plan.empty()) plan.back() += static_cast<std::uint32_t>(left);
    return plan;
}

}  // namespace limn::tracing
