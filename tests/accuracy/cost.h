// What the answers cost: beside the report, for comparing two versions on one quiet machine.
#pragma once

#include <nlohmann/json.hpp>

namespace limn::accuracy {

// Nanoseconds a ray, single thread: the shapes' own hit(), and closest_hit in compiled scenes.
nlohmann::ordered_json measure_cost();

}  // namespace limn::accuracy
