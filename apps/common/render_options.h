/// \file
/// The options that `limn render` and the figures share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "figure.h"
#include "options.h"
#include "parse.h"
#include "picture_output.h"

namespace limn::app {

/// The options of the camera. An option that is not given is empty.
struct CameraOptions {
    std::optional<Point3> look_from, look_at;
    std::optional<Vec3> up;
    std::optional<double> vertical_fov, aperture_angle, focus_distance, view_height;
    std::optional<Projection> projection;
};

/// The options of a render. An option that is not given is empty.
struct RenderOptions : PictureOptions {
    std::optional<Size> size;
    std::optional<int> samples_per_pixel, threads, max_depth;
    std::optional<std::uint64_t> seed;
    std::optional<double> error;       ///< RenderSettings::error
    std::optional<double> time_limit;  ///< in seconds
    std::optional<Shard> shard;
    std::string checkpoint, resume, plan;  ///< paths or empty
    std::optional<double> every;           ///< seconds between two checkpoints
    std::optional<double> preview;         ///< seconds between two previews
    std::optional<PixelBounds> crop;
    std::optional<Estimator> estimator;
    std::optional<SamplerKind> sampler;
    CameraOptions camera;
    bool uniform = false;
    bool no_antialias = false;
};

/// The default of RenderOptions::every, in seconds.
inline constexpr double kEvery = 60;

/// Adds the options. Parsing stores their values in `values`, which must exist until then. It throws an ArgumentError
/// that names an invalid value.
/// \param outputs the pictures that are written without -o and --film, as text for --help; empty if there are none
void add_render_options(Options& options, RenderOptions& values, const std::string& outputs = "");

/// States the figure's settings in --help as defaults of the options.
void state_presets(Options& options, const Figure& figure);

/// Checks that the options do not contradict each other and that something is written. Sets options.outputs to
/// `outputs` if neither -o nor --film is given and the whole picture is rendered. \throws ArgumentError
void check_together(RenderOptions& options, const std::vector<std::string>& outputs = {});

/// Replaces the figure's settings by the options that are given.
/// \throws ArgumentError if an option does not fit the figure's projection or size
void apply(const RenderOptions& options, Figure& figure);

/// Checks the camera's options as far as that is possible without a figure: eye and target must differ, and the up
/// direction must not be parallel to the view direction. \throws ArgumentError
void check_camera_alone(const CameraOptions& options);

}  // namespace limn::app
