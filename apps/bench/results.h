/// \file
/// The results of `limn bench` for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "bench/session.h"
#include "json_output.h"

namespace limn::bench {

std::string results_table(const std::vector<SceneResult>& results);
// `complete`: whether the plan was carried out to its end.
app::Json results_json(const Plan& plan, const std::vector<std::shared_ptr<const Contender>>& peers,
                       const std::vector<SceneResult>& results, bool complete);

}  // namespace limn::bench
