#include "render/film.h"

#include <algorithm>
#include <limits>
#include <string>

#include "limn/core/error.h"

namespace limn::tracing {

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
    p.squares += sample * sample;
    const double kLargest = std::numeric_limits<float>::max();
    p.largest = std::max(p.largest, static_cast<float>(std::min(luminance(sample), kLargest)));
    return true;
}

Color Film::mean(int x, int y) const {
    const Pixel& p = pixels_[index(x, y)];
    if (p.samples == 0) return {};
    Color sum;
    for (const Color& c : p.sums) sum += c;
    return sum / p.samples;
}

std::uint32_t Film::replicate_samples(int x, int y, std::uint32_t r) const {
    const std::uint32_t all = pixels_[index(x, y)].samples;
    return all / kReplicates + (r < all % kReplicates ? 1 : 0);
}

Color Film::replicate_mean(int x, int y, std::uint32_t r) const {
    return pixels_[index(x, y)].sums[r] / replicate_samples(x, y, r);
}

Color Film::variance(int x, int y) const {
    static_assert(kReplicates == 2);
    const double n = samples(x, y), first = replicate_samples(x, y, 0), second = replicate_samples(x, y, 1);
    const Color difference = replicate_mean(x, y, 0) - replicate_mean(x, y, 1);
    return difference * difference / (n * (1 / first + 1 / second));
}

Color Film::independent_variance(int x, int y) const {
    const Pixel& p = pixels_[index(x, y)];
    const double n = p.samples;
    const Color m = mean(x, y), about_mean = p.squares / n - m * m;
    const auto positive = [](double v) { return std::max(0.0, v); };  // rounding may leave it under 0
    return Color{positive(about_mean.r), positive(about_mean.g), positive(about_mean.b)} / (n - 1);
}

double Film::largest_share(int x, int y) const {
    const double sum = luminance(mean(x, y)) * samples(x, y);
    return sum > 0 ? std::min(1.0, pixels_[index(x, y)].largest / sum) : 0;
}

Image Film::image() const {
    Image image(width_, height_);
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) image.set(x, y, mean(x, y));
    return image;
}

double Film::mean_samples() const {
    double sum = 0;
    for (const Pixel& p : pixels_) sum += p.samples;
    return sum / static_cast<double>(pixels_.size());
}

std::uint32_t Film::fewest_samples() const {
    std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
    for (const Pixel& p : pixels_) fewest = std::min(fewest, p.samples);
    return fewest;
}

}  // namespace limn::tracing
