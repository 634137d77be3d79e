/// \file
/// How to render.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

namespace limn {

/// How far a render has come.
struct Progress {
    double fraction = 0;  ///< 0 to 1, never decreasing
    double seconds = 0;   ///< since the render began
};

/// How radiance is estimated. `path` samples lights and scattering and weighs both by multiple importance sampling;
/// `naive` follows scattering alone, its slow but simple check. Both are unbiased.
enum class Estimator : std::uint8_t { path, naive };

/// See RenderSettings::max_depth.
inline constexpr int kUnlimitedDepth = std::numeric_limits<int>::max();

/// What `render` needs besides scene and camera.
struct RenderSettings {
    int width = 400;             ///< in pixels, 1 to 1048576
    int height = 400;            ///< in pixels, 1 to 1048576
    int samples_per_pixel = 64;  ///< at least 1; from 4 on the picture's error is estimated
    int max_depth = 10;      ///< ray segments a path, at least 1; kUnlimitedDepth: paths end by Russian roulette alone
    std::uint64_t seed = 0;  ///< another seed gives independent noise
    int threads = 0;  ///< 0: as many as the caller's TBB arena has; at most 1024. The picture does not depend on it.
    bool antialias = true;  ///< box filter over the pixel; false: every sample goes through the pixel's centre
    Estimator estimator = Estimator::path;  ///< both converge to the same picture
    /// Called at the start, at the end, and at most every 50 ms in between, by any thread but never by two at once;
    /// return false to stop with what has been done.
    std::function<bool(const Progress&)> progress{};
};

}  // namespace limn
