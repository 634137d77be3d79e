/// \file
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

inline constexpr int kUnlimitedDepth = std::numeric_limits<int>::max();

struct RenderSettings {
    int width = 400;
    int height = 400;
    int samples_per_pixel = 64;
    int max_depth = 10;  ///< ray segments a path; kUnlimitedDepth: paths end by Russian roulette alone
    std::uint64_t seed = 0;
    int threads = 0;        ///< 0: as many as the caller's TBB arena has. The picture does not depend on it.
    bool antialias = true;  ///< box filter over the pixel; false: every sample goes through the pixel's centre
    Estimator estimator = Estimator::path;
    /// Called now and then, never by two threads at once; return false to stop with what has been done.
    std::function<bool(const Progress&)> progress{};
};

}  // namespace limn
