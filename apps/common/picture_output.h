/// \file
/// Writing pictures and the report of a film. Renders and merges share it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limn/render/first_hits.h"
#include "limn/render/render.h"
#include "limn/render/render_job.h"
#include "options.h"
#include "program.h"

namespace limn::app {

/// The options of outputs.
struct PictureOptions {
    std::vector<std::string> outputs;   ///< paths of the pictures
    std::vector<std::string> channels;  ///< further channels of EXR pictures
    double exposure = 0;                ///< of PNG pictures, in stops
    bool half = false;                  ///< true: the colours of EXR pictures have 16 bits a value
    bool quiet = false;                 ///< true: only errors are printed
    std::string report;                 ///< path, "-" or empty
    std::string film;                   ///< path or empty
    std::string command_line;           ///< the whole command, which is written to the picture's header

    /// Returns the paths of the pictures, the report and the film.
    std::vector<std::string> all_outputs() const;
};

/// Adds the options. Parsing stores their values in `values`, which must exist until then.
/// \param has_scene true if --channels may name first hits, which need the scene
/// \param outputs the pictures that are written without -o and --film, as text for --help; empty if there are none
void add_picture_options(Options& options, PictureOptions& values, bool has_scene, const std::string& outputs = "");

/// Returns true if --channels names a channel of FirstHits.
bool wants_first_hits(const PictureOptions& options);

/// Checks that the pictures, the report and the film can be written.
/// \throws ArgumentError if there are channels but no picture that can store them, FileError if a file cannot be
/// written
void check_picture_options(const PictureOptions& options);

/// Saves the pictures and then the report. If a picture cannot be saved, the others are saved nevertheless: they may
/// have taken hours. A FileError of the report is thrown.
/// \param hits must be given if wants_first_hits
/// \returns true if all pictures were saved; errors are printed on the console
bool save_pictures(const RenderResult& result, const FilmInfo& info, const PictureOptions& options,
                   const Console& console, const std::optional<FirstHits>& hits = {});

/// Saves the pictures of a job that may be running, without further channels.
void save_preview(const RenderJob& job, const FilmInfo& info, const PictureOptions& options, const Console& console);

}  // namespace limn::app
