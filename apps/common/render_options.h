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

namespace limn::app {

struct CameraOptions {
    std::optional<Point3> look_from, look_at;
    std::optional<Vec3> up;
    std::optional<double> vertical_fov, aperture_angle, focus_distance;
};

/// What the command line says; empty where it says nothing.
struct RenderOptions {
    std::vector<std::string> outputs;
    std::optional<Size> size;
    std::optional<int> samples_per_pixel, threads, max_depth;
    std::optional<std::uint64_t> seed;
    std::optional<double> error, time_limit;
    std::optional<Estimator> estimator;
    std::optional<SamplerKind> sampler;
    CameraOptions camera;
    std::vector<std::string> channels;  ///< that an EXR gets beside its colours
    bool uniform = false;
    bool no_antialias = false;
    bool half = false;
    bool quiet = false;
    std::string report;        ///< path, "-" or empty
    std::string command_line;  ///< for the picture's header

    /// The pictures and the report.
    std::vector<std::string> all_outputs() const;
};

/// Adds the options, bound to `values`, which must outlive the parsing. A value that cannot be right is refused while
/// parsing, with an ArgumentError that names it; so are the options that later versions will bring.
/// \param outputs what is written without -o, for --help; empty: -o is required
void add_render_options(Options& options, RenderOptions& values, const std::string& outputs = "");

/// Says in --help what the figure has where the command line says nothing.
void state_presets(Options& options, const Figure& figure);

/// Replaces what the command line names.
void apply(const RenderOptions& options, Figure& figure);

/// Refuses a camera that is impossible whatever the figure: eye equal to target, up along the view.
/// \throws ArgumentError
void check_camera_alone(const CameraOptions& options);

/// The arguments as one line that a shell would read back.
std::string command_line(int argc, const char* const* argv);

}  // namespace limn::app
