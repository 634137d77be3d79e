/// \file
/// The whole way from options to files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "figure.h"
#include "program.h"
#include "render_options.h"

namespace limn::app {

struct RenderTask {
    /// Reads files, each step within from_files, and describes the scene.
    std::function<Figure()> make;
    /// Files that `make` reads, which no output may replace; empty names do not count.
    std::vector<std::string> inputs;
};

/// Checks everything that can be known, makes the figure, renders it, with checkpoints if their option is given, saves
/// the film and every picture, then the report. Nothing is created before there are pixels to save. SIGINT and SIGTERM
/// end the render early; what is done is saved.
/// \returns the exit status
/// \throws ArgumentError, FileError, Error for what is found wrong before rendering
int run_render_task(const RenderTask& task, const RenderOptions& options, const Console& console);

}  // namespace limn::app
