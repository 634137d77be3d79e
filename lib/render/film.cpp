#include "render/film.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "limn/core/error.h"

namespace limn::tracing {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kDarkness = 0.01;  // of the error metric: design of relMSE, see image/compare.h

std::array<double, 3> channels(const Color& c) { return {c.r, c.g, c.b}; }

}  // namespace

Film::Film(int width, int height) : width_(width), height_(height) {
    try {
        pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    } catch (const std::exception&) {
        throw Error("render: not enough memory for a picture of " + std::to_string(width) + " x " +
                    std::to_string(height));
    }
}

bool Film::add(int x, int y, const Color& sample) {
    Pixel& p = pixels_[index(x, y)];
    const std::uint32_t replicate = p.samples++ % kReplicates;
    if (!is_finite(sample)) return false;
    p.sums[replicate] += sample;
    p.largest = std::max(p.largest, luminance(sample));
    return true;
}

Color Film::mean(const Pixel& p) {
    if (p.samples == 0) return {};
    Color sum;
    for (const Color& c : p.sums) sum += c;
    return sum / p.samples;
}

Image Film::image() const {
    Image image(width_, height_);
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) image.set(x, y, mean(pixels_[index(x, y)]));
    return image;
}

double Film::mean_samples() const {
    double sum = 0;
    for (const Pixel& p : pixels_) sum += p.samples;
    return sum / static_cast<double>(pixels_.size());
}

// relMSE of the mean: its numerator is the variance of the mean of N samples in R = 4 independent replicates of n_r
// each, sum of n_r (replicate mean - mean)^2 / ((R - 1) N), unbiased for unequal n_r too. The denominator r^2 + 0.01 is
// taken twice, from the pixel and from the 5x5 mean around it.
ErrorEstimate Film::error() const {
    ErrorEstimate e;
    std::vector<double> shares;
    shares.reserve(pixels_.size());
    std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
    std::vector<Color> means(pixels_.size());
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const Pixel& p = pixels_[i];
        means[i] = mean(p);
        fewest = std::min(fewest, p.samples);
        const double sum = luminance(means[i]) * p.samples;
        shares.push_back(sum > 0 ? p.largest / sum : 0);
    }
    const auto rank = static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(shares.size() - 1));
    std::nth_element(shares.begin(), shares.begin() + rank, shares.end());
    e.max_sample_share = shares[static_cast<std::size_t>(rank)];
    if (fewest < kReplicates) {
        e.estimate = e.ci95_low = e.ci95_high = kNaN;
        e.reason = "fewer than " + std::to_string(kReplicates) + " samples in a pixel";
        return e;
    }

    // Blocks small enough that some 64 of them fit, so that their spread is known.
    const int block = std::clamp(std::min(width_, height_) / 8, 1, 16);
    const int columns = (width_ + block - 1) / block, rows = (height_ + block - 1) / block;
    struct Block {
        double by_pixel = 0, by_surround = 0;
    };
    std::vector<Block> blocks(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
            const Pixel& p = pixels_[index(x, y)];
            Color surround;
            int neighbours = 0;
            for (int j = std::max(0, y - 2); j <= std::min(height_ - 1, y + 2); ++j)
                for (int i = std::max(0, x - 2); i <= std::min(width_ - 1, x + 2); ++i, ++neighbours)
                    surround += means[index(i, j)];
            const auto around = channels(surround / neighbours), here = channels(means[index(x, y)]);
            std::array<double, 3> variance{};
            for (std::uint32_t r = 0; r < kReplicates; ++r) {
                const std::uint32_t count = p.samples / kReplicates + (r < p.samples % kReplicates ? 1 : 0);
                const auto replicate = channels(p.sums[r] / count);
                for (std::size_t c = 0; c < 3; ++c) variance[c] += count * std::pow(replicate[c] - here[c], 2);
            }
            Block& b = blocks[static_cast<std::size_t>(y / block) * static_cast<std::size_t>(columns) +
                              static_cast<std::size_t>(x / block)];
            for (std::size_t c = 0; c < 3; ++c) {
                const double of_mean = variance[c] / ((kReplicates - 1.0) * p.samples);
                b.by_pixel += of_mean / (here[c] * here[c] + kDarkness);
                b.by_surround += of_mean / (around[c] * around[c] + kDarkness);
            }
        }
    }
    double by_pixel = 0, by_surround = 0;
    for (const Block& b : blocks) by_pixel += b.by_pixel, by_surround += b.by_surround;
    const bool pixel_counts = by_pixel >= by_surround;
    const double values = 3 * static_cast<double>(pixels_.size()), count = static_cast<double>(blocks.size());
    e.estimate = std::max(by_pixel, by_surround) / values;
    // The sum over blocks has a standard error of sqrt(n) times the blocks' standard deviation.
    const double block_mean = std::max(by_pixel, by_surround) / count;
    double squares = 0;
    for (const Block& b : blocks) squares += std::pow((pixel_counts ? b.by_pixel : b.by_surround) - block_mean, 2);
    if (blocks.size() < 2) {
        e.ci95_low = e.ci95_high = kNaN;
        return e;
    }
    const double standard_error = std::sqrt(squares / (count - 1) * count) / values;
    e.ci95_low = std::max(0.0, e.estimate - 1.96 * standard_error);
    e.ci95_high = e.estimate + 1.96 * standard_error;
    return e;
}

}  // namespace limn::tracing
