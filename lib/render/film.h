// The film: sums of samples, in two replicates from which the render learns its own error (error_estimate.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "limn/core/color.h"
#include "limn/image/image.h"

namespace limn::tracing {

inline constexpr int kReplicates = 2;
// Samples of each pixel in the first pass of a render. From so many on there is an estimate of the error, and they tell
// adaptive sampling how noisy the pixels are.
inline constexpr int kFirstPass = 8;

// Sample i of a pixel belongs to replicate i mod 2. Each pixel has one owner at a time and gets its samples in order,
// so that the sums, in double, do not depend on threads.
class Film {
public:
    // \throws Error if memory lacks
    Film(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }
    // Samples so far of the pixel in row y, column x.
    std::uint32_t samples(int x, int y) const { return pixels_[index(x, y)].samples; }
    // A sample that is not finite counts as black; the result says whether it was finite.
    bool add(int x, int y, const Color& sample);

    // Mean of all samples, black if there is none yet.
    Color mean(int x, int y) const;
    // Samples in replicate r, and their mean. \pre there is one
    std::uint32_t replicate_samples(int x, int y, std::uint32_t r) const;
    Color replicate_mean(int x, int y, std::uint32_t r) const;
    // The variance of the mean, estimated without bias from the difference of the replicates: one degree of freedom.
    // \pre each has a sample
    Color variance(int x, int y) const;
    // What that variance would be if all samples were independent: the points of a replicate are not, but this estimate
    // has a degree of freedom for all samples but one. \pre there are two
    Color independent_variance(int x, int y) const;
    // The largest share that one sample has of the pixel's luminance, 0 to 1.
    double largest_share(int x, int y) const;

    Image image() const;
    double mean_samples() const;
    std::uint32_t fewest_samples() const;
    std::size_t memory_bytes() const { return pixels_.size() * sizeof(Pixel); }

    // Of a pixel in tables that go row by row, and how many there are.
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    std::size_t pixels() const { return pixels_.size(); }

private:
    struct Pixel {
        std::array<Color, kReplicates> sums;
        Color squares;      // sum of the squares of the samples
        float largest = 0;  // luminance of the brightest sample
        std::uint32_t samples = 0;
    };
    static_assert(sizeof(Pixel) == 80);

    int width_, height_;
    std::vector<Pixel> pixels_;
};

}  // namespace limn::tracing
