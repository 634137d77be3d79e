#include "limn/image/compare.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "image/compare_values.h"

namespace limn {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double square(double x) { return x * x; }

double encode_clamped(double linear) { return srgb_encode(std::clamp(linear, 0.0, 1.0)); }

// Returns the sum of the largest 0.1 % of `errors`, but of at least one, divided by `sum`, the sum of all. Returns NaN
// if that is 0. Reorders the errors.
double share_of_worst(std::vector<double>& errors, double sum) {
    const std::size_t count = (errors.size() + 999) / 1000;
    const auto end = errors.begin() + static_cast<std::ptrdiff_t>(count);
    std::nth_element(errors.begin(), end - 1, errors.end(), std::greater<>());
    double worst = 0;
    for (auto e = errors.begin(); e != end; ++e) worst += *e;
    return sum > 0 ? worst / sum : kNaN;
}

// Compares a test image with a reference. reference(i) returns value i of the reference in double.
template <class Reference>
ImageMetrics compare(const Image& test, Reference reference) {
    // Sum up the errors of all values, and find the largest.
    const std::span<const float> values = test.values();
    ImageMetrics m;
    std::size_t largest = 0;
    double encoded_mse = 0;
    std::vector<double> relative(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double x = values[i], r = reference(i), difference = std::abs(x - r);
        m.nonfinite_test += !std::isfinite(x);
        m.nonfinite_reference += !std::isfinite(r);
        if (!std::isfinite(difference)) {
            if (m.valid) largest = i;  // an invalid comparison reports the first value that isn't finite
            m.valid = false;
            continue;
        }
        relative[i] = relative_squared_error(x, r);
        m.relative_mse += relative[i];
        m.mse += square(difference);
        if (difference > 0) m.smape += 2 * difference / (std::abs(x) + std::abs(r));
        encoded_mse += square(encode_clamped(x) - encode_clamped(r));
        if (m.valid && relative[i] > relative[largest]) largest = i;
    }
    // Store the position of the largest.
    const std::size_t pixel = largest / 3, width = static_cast<std::size_t>(test.width());
    m.largest_x = static_cast<int>(pixel % width);
    m.largest_y = static_cast<int>(pixel / width);
    if (!m.valid) {
        m.relative_mse = m.mse = m.smape = m.psnr_srgb = m.largest_relative = m.worst_share = kNaN;
        return m;
    }
    // Compute the means.
    const double n = static_cast<double>(values.size());
    m.largest_relative = std::sqrt(relative[largest]);
    m.worst_share = share_of_worst(relative, m.relative_mse);
    m.relative_mse /= n;
    m.mse /= n;
    m.smape /= n;
    m.psnr_srgb = -10 * std::log10(encoded_mse / n);  // the peak is 1
    return m;
}

}  // namespace

ImageMetrics compare_images(const Image& test, const Image& reference) {
    require_same_size(test, reference, "compare_images");
    return compare(test, [r = reference.values()](std::size_t i) { return static_cast<double>(r[i]); });
}

ImageMetrics compare_images(const Image& test, const Image& reference_a, const Image& reference_b) {
    require_same_size(test, reference_a, "compare_images");
    require_same_size(test, reference_b, "compare_images");
    const std::span<const float> a = reference_a.values(), b = reference_b.values();
    const auto mean = [a, b](std::size_t i) { return mean_of_halves(a[i], b[i]); };
    ImageMetrics m = compare(test, mean);
    m.has_reference_error = true;
    if (!m.valid) {
        m.reference_relative_mse = m.corrected_relative_mse = kNaN;
        return m;
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        m.reference_relative_mse += relative_squared_error(a[i], mean(i));  // a - mean = (a - b) / 2
    }
    m.reference_relative_mse /= static_cast<double>(a.size());
    m.corrected_relative_mse = m.relative_mse - m.reference_relative_mse;
    m.reference_too_noisy = m.reference_relative_mse > m.relative_mse / 10;
    return m;
}

}  // namespace limn
