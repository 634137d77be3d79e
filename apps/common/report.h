/// \file
/// What is known of a render: the JSON of --report, and the facts in a picture's header.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "limn/render/render.h"

namespace limn::app {

/// One JSON object. What is not a finite number is null.
std::string report_json(const RenderResult& result, double save_seconds);

/// The same under the same names as far as it is known before saving, and how the picture was made.
std::vector<std::pair<std::string, std::string>> picture_facts(const RenderResult& result, const FilmInfo& info,
                                                               const std::string& command_line);

}  // namespace limn::app
