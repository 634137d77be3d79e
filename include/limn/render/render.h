/// \file
/// Rendering a scene to a picture.
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

/// The estimated relMSE of a picture (see ImageMetrics::relative_mse), computed from the difference of two independent
/// replicates. It cannot include light that no path has found.
///
/// The reference value in the denominator is between the pixel's own value and the mean of the eight pixels around it.
/// It is nearer to the pixel's own value the more the 3x3 pixels differ beyond their noise.
///
/// There is no estimate if
/// - the film is not whole,
/// - a pixel has fewer than 8 samples,
/// - the squares of samples are not finite,
/// - too much of the noise comes from pixels in which a single sample found most of the light.
struct ErrorEstimate {
    double estimate = 0;  ///< the relMSE; NaN if there is no estimate
    /// The 95 % interval of the picture's true error; NaN if there is no estimate.
    ///@{
    double ci95_low = 0, ci95_high = 0;
    ///@}
    /// The 99.9th percentile over the pixels of Film::largest_share: the largest share that one sample has in the
    /// luminance of its pixel, 0 to 1.
    double max_sample_share = 0;
    std::string reason;              ///< why there is no estimate; empty if there is one
    std::optional<double> target{};  ///< RenderSettings::error
    bool reached = false;            ///< true if there is a target and ci95_high is at most the target
};

/// The reason why a render ended: the number of samples, RenderSettings::error, RenderSettings::time_limit, or the
/// progress callback.
enum class StoppedBy : std::uint8_t { samples, error, time, callback };

/// The settings, the cost and the end of a render.
struct RenderReport {
    std::string scene;                    ///< Scene::name
    int width = 0;                        ///< width of the rendered window in pixels
    int height = 0;                       ///< height of the rendered window in pixels
    std::uint64_t seed = 0;               ///< RenderSettings::seed
    int threads = 0;                      ///< number of threads of the render
    int max_depth = 0;                    ///< RenderSettings::max_depth
    double samples_per_pixel = 0;         ///< mean number of samples per pixel
    double compile_seconds = 0;           ///< time that `compile` took
    double render_seconds = 0;            ///< time that the samples took, in all runs and shards
    std::uint64_t rays = 0;               ///< number of camera, scattered and shadow rays
    std::uint64_t nonfinite_samples = 0;  ///< number of samples that were not finite; they count as black
    /// The number of `rays` that are unusable (see is_usable) because a shape or material has extreme numbers. They
    /// carry no light.
    std::uint64_t unusable_rays = 0;
    std::string features;          ///< CompiledScene::features
    std::size_t memory_bytes = 0;  ///< memory of the compiled scene and the film
    /// False if the progress callback, or the caller's own TBB context, stopped the render.
    bool complete = true;
    StoppedBy stopped_by = StoppedBy::samples;  ///< why the render ended
};

/// Numbers for each pixel of a picture, row by row from the top left pixel.
struct PixelMaps {
    /// The estimated relMSE of each pixel. Its mean is ErrorEstimate::estimate. It is empty if there is no estimate.
    std::vector<float> error;
    std::vector<float> samples;  ///< number of samples of each pixel
    /// The alpha of each pixel of a transparent picture, else empty. Alpha is the share of the pixel that is not
    /// background, 0 to 1. A path that is scattered or hits a surface counts as 1. A path that a medium only attenuates
    /// counts as 1 minus the mean transmittance of the three channels.
    ///
    /// Colours are multiplied by alpha (associated alpha): image + (1 - alpha) background is the picture over a
    /// background of one colour.
    std::vector<float> alpha;
};

/// The result of a render.
struct RenderResult {
    Image image;          ///< the picture, linear and not clamped
    ErrorEstimate error;  ///< the estimated error of `image`
    /// The report on all runs and shards that made the film. `threads`, `complete` and `stopped_by` are those of the
    /// last run.
    RenderReport report;
    PixelMaps maps;  ///< further numbers for each pixel of `image`
};

/// Renders a scene. Several threads may render the same scene at the same time. The picture depends on scene, camera
/// and settings, but not on `threads` or the machine, unless a time limit or the progress callback ends the render.
///
/// \throws ArgumentError if the settings or the camera are invalid
///
/// \throws Error if a primitive has no material, or there is not enough memory
///
/// An exception of the progress callback or of a user-defined object is passed on.
RenderResult render(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings = {});

/// Returns the picture of a film with its error and report. The report's `threads` and `compile_seconds` are 0, and its
/// `memory_bytes` is that of the film. The function runs on the threads of the caller's TBB arena.
/// \param film the film
/// \param error the target of the error, for ErrorEstimate::target and ErrorEstimate::reached
/// \throws ArgumentError if `error` is not positive and finite
RenderResult render_result(const Film& film, std::optional<double> error = {});

/// Returns limn's version, "major.minor.patch".
const char* version();

}  // namespace limn
