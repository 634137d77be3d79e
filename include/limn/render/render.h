/// \file
/// Pictures from scenes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "limn/image/image.h"
#include "limn/query/compiled_scene.h"
#include "limn/render/film.h"
#include "limn/render/settings.h"
#include "limn/scene/camera.h"

namespace limn {

/// What the render knows of its own relMSE (see image/compare.h), from the difference of two independent replicates.
/// The reference in the denominator lies between the mean of the eight pixels around and the pixel's own, nearer to its
/// own the more the 3x3 pixels differ beyond their noise. There is no estimate with fewer than 8 samples in a pixel,
/// where too much of the noise comes from samples that found light alone in their pixels, or where the squares of
/// samples are no numbers. Light that no path has found yet cannot be seen.
struct ErrorEstimate {
    double estimate = 0;  ///< NaN where there is none
    /// The 95 % interval of the picture's true error, from the spread over pixels; NaN where there is none.
    ///@{
    double ci95_low = 0, ci95_high = 0;
    ///@}
    /// 99.9th percentile over pixels of the largest share that one sample has of its pixel, 0 to 1.
    double max_sample_share = 0;
    std::string reason;              ///< why there is no estimate; empty where there is one
    std::optional<double> target{};  ///< RenderSettings::error
    bool reached = false;            ///< there is a target, and ci95_high is at or under it
};

/// What ended a render: the number of samples, RenderSettings::error, RenderSettings::time_limit or the callback.
enum class StoppedBy : std::uint8_t { samples, error, time, callback };

/// What was rendered, how, and what it cost.
struct RenderReport {
    std::string scene;                    ///< Scene::name
    int width = 0;                        ///< in pixels
    int height = 0;                       ///< in pixels
    std::uint64_t seed = 0;               ///< as asked for
    int threads = 0;                      ///< that the render had
    int max_depth = 0;                    ///< as asked for
    double samples_per_pixel = 0;         ///< mean over pixels
    double compile_seconds = 0;           ///< that `compile` took
    double render_seconds = 0;            ///< that its samples took, in all runs and parts
    std::uint64_t rays = 0;               ///< camera, scattered and shadow rays
    std::uint64_t nonfinite_samples = 0;  ///< counted as black
    /// Of `rays`, those that a shape or material of extreme numbers made unusable (see is_usable): they carry
    /// no light.
    std::uint64_t unusable_rays = 0;
    std::string features;                       ///< CompiledScene::features
    std::size_t memory_bytes = 0;               ///< compiled scene and film
    bool complete = true;                       ///< false if the callback stopped it, or the caller's own TBB context
    StoppedBy stopped_by = StoppedBy::samples;  ///< the first to hit
};

/// What is known of each pixel, row by row from the top left one.
struct PixelMaps {
    /// The pixel's own estimated relMSE, of which ErrorEstimate::estimate is the mean; empty where there is none.
    std::vector<float> error;
    std::vector<float> samples;  ///< that the pixel has
    /// Of a transparent picture, otherwise empty: how much of the pixel is not background, 0 to 1. That is the part of
    /// the camera's paths that met something; a path that media weakened, and nothing else, counts by the mean of its
    /// channels. Colours are multiplied by it (associated alpha): image + (1 - alpha) background is the picture with
    /// a background of one colour.
    std::vector<float> alpha;
};

/// A picture and what is known of it.
struct RenderResult {
    Image image;          ///< linear, not clamped
    ErrorEstimate error;  ///< of `image`
    /// Of all runs and parts that made the film; `threads`, `complete` and `stopped_by` of the last run.
    RenderReport report;
    PixelMaps maps;  ///< of `image`
};

/// Renders. Thread-safe: several renders may share a scene. The pixels depend on scene, camera and settings, but not on
/// `threads` and `progress`, unless a time limit or the callback ends the render.
///
/// \throws ArgumentError for impossible settings or an impossible camera, Error if a primitive has no material or
/// memory lacks; what the progress callback or a user-defined object throws
RenderResult render(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings = {});

/// What a film is worth so far; `error` is the one that was asked for. Of the report those fields that only a render
/// knows are empty. Runs on the threads of the caller's TBB arena. \throws ArgumentError if `error` is not positive and
/// finite
RenderResult render_result(const Film& film, std::optional<double> error = {});

/// limn's version, "major.minor.patch".
const char* version();

}  // namespace limn
