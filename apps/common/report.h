/// \file
/// The report of a render: the JSON of --report, and the facts in a picture's header.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "limn/render/render.h"

namespace limn::app {

/// Returns the report as one JSON object. Infinities and NaN are null.
/// \param save_seconds the time that saving the pictures took
std::string report_json(const RenderResult& result, double save_seconds);

/// Returns the facts for a picture's header, as names and texts: most of the report under the same names, the settings
/// and the command line.
std::vector<std::pair<std::string, std::string>> picture_facts(const RenderResult& result, const FilmInfo& info,
                                                               const std::string& command_line);

}  // namespace limn::app
