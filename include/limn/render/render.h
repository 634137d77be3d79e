/// \file
#pragma once

#include <cstdint>
#include <string>

#include "limn/image/image.h"
#include "limn/render/compiled_scene.h"
#include "limn/render/settings.h"
#include "limn/scene/camera.h"

namespace limn {

/// What the render knows of its own relMSE (see image/compare.h), from the variance between four independent
/// replicates. The denominator is taken from the pixel itself and from the 5x5 mean around it; the larger estimate
/// counts. Light that no path has found yet cannot be seen.
struct ErrorEstimate {
    double estimate = 0;                 ///< NaN where there is none
    double ci95_low = 0, ci95_high = 0;  ///< from the spread over blocks of pixels; NaN where there is none
    double max_sample_share =
        0;               ///< 99.9th percentile over pixels of the largest share that one sample has of its pixel
    std::string reason;  ///< why there is no estimate; empty where there is one
};

struct RenderReport {
    std::string scene;
    int width = 0, height = 0;
    std::uint64_t seed = 0;
    int threads = 0;  ///< that the render had
    int max_depth = 0;
    double samples_per_pixel = 0;  ///< mean over pixels; less than asked for if it was stopped
    double compile_seconds = 0, render_seconds = 0;
    std::uint64_t rays = 0;
    std::uint64_t nonfinite_samples = 0;  ///< counted as black
    std::string features;
    std::size_t memory_bytes = 0;  ///< compiled scene and film
    bool complete = true;          ///< false if it was stopped
};

struct RenderResult {
    Image image;
    ErrorEstimate error;
    RenderReport report;
};

/// Renders. The pixels depend on scene, camera, size, samples, depth, seed, filter and estimator alone: not on threads.
/// \throws ArgumentError for impossible settings or an impossible camera, Error if a primitive has no material or
/// memory lacks; what the progress callback throws
RenderResult render(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings = {});

/// limn's version, "major.minor.patch".
const char* version();

}  // namespace limn
