/// \file
/// How to render.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

#include "limn/image/image.h"

namespace limn {

/// How far a render has come.
struct Progress {
    double fraction = 0;  ///< 0 to 1, never decreasing; an estimate where an error or a time was asked for
    double seconds = 0;   ///< since this run began
};

/// How radiance is estimated. `path` samples lights and scattering and weighs both by multiple importance sampling;
/// `naive` follows scattering alone, its slow but simple check. Both are unbiased.
enum class Estimator : std::uint8_t { path, naive };

/// Where a pixel's random numbers come from. `sobol`: Owen-scrambled Sobol points, which fill the unit square evenly
/// from the first to the last sample; `independent`: a counter-based generator. Both are unbiased.
enum class SamplerKind : std::uint8_t { sobol, independent };

/// See RenderSettings::max_depth.
inline constexpr int kUnlimitedDepth = std::numeric_limits<int>::max();
/// See RenderSettings::width and height.
inline constexpr int kMaxSide = 1 << 20;
/// See RenderSettings::max_samples_per_pixel.
inline constexpr int kMostSamples = 1 << 20;

/// A part of a picture: of its tiles of 16x16 pixels one in `count`, evenly spread. The shards of a picture take about
/// the same time, as long as each has some dozens.
struct Shard {
    int index = 1;  ///< 1 to count
    int count = 1;  ///< at most the number of tiles
};

/// What `render` needs besides scene and camera.
struct RenderSettings {
    int width = 400;             ///< in pixels, 1 to 1048576
    int height = 400;            ///< in pixels, 1 to 1048576
    int samples_per_pixel = 64;  ///< at least 1; from 8 on the error is estimated; `error` and `time_limit` replace it
    int max_depth = 10;      ///< ray segments a path, at least 1; kUnlimitedDepth: paths end by Russian roulette alone
    std::uint64_t seed = 0;  ///< another seed gives independent noise
    int threads = 0;  ///< 0: as many as the caller's TBB arena has; at most 1024. The picture does not depend on it.
    bool antialias = true;  ///< box filter over the pixel; false: every sample goes through the pixel's centre
    Estimator estimator = Estimator::path;     ///< both converge to the same picture
    SamplerKind sampler = SamplerKind::sobol;  ///< both converge to the same picture
    /// The relMSE to render to, over 0: the render ends at the first check, from 8 samples a pixel on, at which the
    /// upper end of the estimate's 95 % interval is at or under it. How many samples that takes does not depend on
    /// threads or time.
    std::optional<double> error{};
    /// Seconds of a run after which it ends with what there is, over 0; but each pixel gets its first 8 samples in any
    /// case. The picture then depends on the machine.
    std::optional<double> time_limit{};
    /// With `error` or `time_limit`: the samples, in the mean over pixels, after which the render ends in any case, at
    /// least 1.
    int max_samples_per_pixel = kMostSamples;
    /// False: after 8 samples in each pixel, pixels in noisy surroundings get more than others, and each gets at least
    /// a quarter of the mean; the picture stays unbiased. True: all pixels get the same number. Matters only with
    /// `error` or `time_limit`.
    bool uniform = false;
    /// The pixels to render, of a picture of `width` x `height`, in which they must lie; not empty. By default all.
    /// With as many samples they are those of the whole picture, bit for bit; where `error` or `time_limit` lets
    /// samples differ, the pixels of the crop window alone decide how many each gets.
    std::optional<PixelBounds> crop{};
    /// Leaves the background out of what the camera sees, but not out of the light: PixelMaps::alpha says where it was.
    bool transparent = false;
    Shard shard{};  ///< the part to render, of a picture whose error is then unknown; the rest stays black
    /// Called at the start, at the end, and at most every 50 ms in between, by any thread but never by two at once;
    /// return false to stop with what has been done.
    std::function<bool(const Progress&)> progress{};
};

}  // namespace limn
