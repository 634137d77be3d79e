/// \file
/// From a film to pictures and a report: what renders and merges share.
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

/// What the command line says about outputs.
struct PictureOptions {
    std::vector<std::string> outputs;   ///< pictures
    std::vector<std::string> channels;  ///< that an EXR gets beside its colours
    double exposure = 0;                ///< in stops, of PNG
    bool half = false;
    bool quiet = false;
    std::string report;        ///< path, "-" or empty
    std::string film;          ///< path or empty
    std::string command_line;  ///< for the picture's header

    /// The pictures, the report and the film.
    std::vector<std::string> all_outputs() const;
};

/// Adds the options, bound to `values`, which must outlive the parsing.
/// \param has_scene whether --channels can be of the first hits
/// \param outputs what is written without -o and --film, for --help; empty: nothing
void add_picture_options(Options& options, PictureOptions& values, bool has_scene, const std::string& outputs = "");

/// Whether one of the channels is of the scene's first hits.
bool wants_first_hits(const PictureOptions& options);

/// Refuses what can be known to fail: channels that no output has a place for, files that cannot be written.
/// \throws ArgumentError, FileError
void check_picture_options(const PictureOptions& options);

/// Saves each picture and the report, whatever becomes of the others: hours of rendering may be in them.
/// \param hits where they are wanted
/// \returns whether all were saved; what was not is said on the console
bool save_pictures(const RenderResult& result, const FilmInfo& info, const PictureOptions& options,
                   const Console& console, const std::optional<FirstHits>& hits = {});

/// Saves what a job that still runs has of each picture.
void save_preview(const RenderJob& job, const FilmInfo& info, const PictureOptions& options, const Console& console);

}  // namespace limn::app
