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

struct CameraOptions {
    std::optional<Point3> look_from, look_at;
    std::optional<Vec3> up;
    std::optional<double> vertical_fov, aperture_angle, focus_distance, view_height;
    std::optional<Projection> projection;
};

/// What the command line says; empty where it says nothing.
struct RenderOptions : PictureOptions {
    std::optional<Size> size;
    std::optional<int> samples_per_pixel, threads, max_depth;
    std::optional<std::uint64_t> seed;
    std::optional<double> error, time_limit;
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

/// See RenderOptions::every.
inline constexpr double kEvery = 60;

/// Adds the options, bound to `values`, which must outlive the parsing. A value that cannot be right is refused while
/// parsing, with an ArgumentError that names it.
/// \param outputs what is written without -o and --film, for --help; empty: one of them is required
void add_render_options(Options& options, RenderOptions& values, const std::string& outputs = "");

/// Says in --help what the figure has where the command line says nothing.
void state_presets(Options& options, const Figure& figure);

/// Refuses options that contradict each other, and a command line that names nothing to write, of which `outputs` are
/// written without -o and --film. \throws ArgumentError
void check_together(RenderOptions& options, const std::vector<std::string>& outputs = {});

/// Replaces what the command line names. \throws ArgumentError if the camera has no such thing
void apply(const RenderOptions& options, Figure& figure);

/// Refuses a camera that is impossible whatever the figure: eye equal to target, up along the view.
/// \throws ArgumentError
void check_camera_alone(const CameraOptions& options);

}  // namespace limn::app
