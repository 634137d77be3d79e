/// \file
/// Running a render, from its options to its files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "figure.h"
#include "program.h"
#include "render_options.h"

namespace limn::app {

/// The figure to render and the files that it reads.
struct RenderTask {
    /// Reads the files and returns the figure. Errors in the files must not be ArgumentErrors: see from_files.
    std::function<Figure()> make;
    /// The files that `make` reads. No output may replace them. Empty paths are ignored.
    std::vector<std::string> inputs;
};

/// Runs a render:
/// - checks the options and outputs as far as possible,
/// - makes the figure and renders it, with checkpoints and previews if they are asked for,
/// - saves the films, the pictures and the report.
/// No film or picture is created before there are pixels to save. SIGINT and SIGTERM end the render early; the pixels
/// so far are saved.
/// \returns the exit status
/// \throws ArgumentError, FileError or Error if a check before rendering fails
int run_render_task(const RenderTask& task, const RenderOptions& options, const Console& console);

}  // namespace limn::app
