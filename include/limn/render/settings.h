/// \file
/// The settings of a render.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

#include "limn/image/image.h"

namespace limn {

/// The progress of a render.
struct Progress {
    double fraction = 0;  ///< finished part, 0 to 1, never decreasing; an estimate if `error` or `time_limit` is set
    double seconds = 0;   ///< time since the run began
};

/// The estimator of radiance. `path` samples lights and scattering and combines them by multiple importance sampling.
/// `naive` samples scattering alone; it is slow, and serves to check `path`. Both are unbiased.
enum class Estimator : std::uint8_t { path, naive };

/// The source of a pixel's random numbers. `sobol` is Owen-scrambled Sobol points, which are evenly distributed at any
/// number of samples. `independent` is a counter-based random number generator. Both are unbiased.
enum class SamplerKind : std::uint8_t { sobol, independent };

/// The value of RenderSettings::max_depth for which paths have no limit: only Russian roulette ends them.
inline constexpr int kUnlimitedDepth = std::numeric_limits<int>::max();
/// The largest RenderSettings::width and height, in pixels.
inline constexpr int kMaxSide = 1 << 20;
/// The default of RenderSettings::max_samples_per_pixel.
inline constexpr int kMostSamples = 1 << 20;

/// A part of a picture: one of `count` sets of tiles of 16x16 pixels. The tiles of a shard are evenly distributed over
/// the picture. All shards take about the same time if each has some dozens of tiles.
struct Shard {
    int index = 1;  ///< number of this shard, 1 to count
    int count = 1;  ///< number of shards, at most the number of tiles
};

/// The settings of a render.
struct RenderSettings {
    int width = 400;   ///< width in pixels, 1 to 1048576
    int height = 400;  ///< height in pixels, 1 to 1048576
    /// The number of samples per pixel, at least 1. The error is estimated from 8 samples on. If `error` or
    /// `time_limit` is set, this number is ignored.
    int samples_per_pixel = 64;
    int max_depth = 10;      ///< largest number of ray segments in a path, at least 1, or kUnlimitedDepth
    std::uint64_t seed = 0;  ///< seed of the random numbers; another seed gives independent noise
    /// The number of threads, up to 1024. 0 is as many as the caller's TBB arena has. The picture does not depend on
    /// it.
    int threads = 0;
    bool antialias = true;  ///< true: box filter over the pixel; false: all samples go through the pixel's centre
    Estimator estimator = Estimator::path;     ///< all values converge to the same picture
    SamplerKind sampler = SamplerKind::sobol;  ///< all values converge to the same picture
    /// The target of the relMSE, positive and finite. From 8 samples per pixel on, the render checks its error from
    /// time to time. It ends at the first check at which ErrorEstimate::ci95_high is at most the target. The number of
    /// samples at the end does not depend on threads or time.
    std::optional<double> error{};
    /// The time in seconds after which a run ends, positive and finite. Each pixel gets its first 8 samples even if
    /// they take longer. The picture depends on the machine.
    std::optional<double> time_limit{};
    /// With `error` or `time_limit`: the mean number of samples per pixel at which the render ends in any case, at
    /// least 1.
    int max_samples_per_pixel = kMostSamples;
    /// True gives all pixels the same number of samples. False gives more samples to pixels in noisy surroundings,
    /// after the first 8 samples of each pixel. Each pixel then gets at least a quarter of the mean number. The picture
    /// is unbiased in both cases. Without `error` and `time_limit` all pixels get the same number in any case.
    bool uniform = false;
    /// The crop window: the pixels to render. It must be inside the picture of `width` x `height` and not empty. By
    /// default all pixels are rendered. A pixel has the same bits as in the whole picture if it has as many samples
    /// there. If `error` or `time_limit` is set, the numbers of samples depend on the pixels of the crop window alone.
    std::optional<PixelBounds> crop{};
    /// True if the camera does not see the background. The background still lights the scene. PixelMaps::alpha tells
    /// how much of each pixel is not background.
    bool transparent = false;
    /// The part of the picture to render. The rest stays black, and there is no estimate of the error. With more than
    /// one shard, neither `error` nor `time_limit` may be set.
    Shard shard{};
    /// A function that is called at the start, at the end, and at most every 50 ms in between. Any thread may call it,
    /// but never two at once. If it returns false, the render ends with the samples that it has.
    std::function<bool(const Progress&)> progress{};
};

}  // namespace limn
