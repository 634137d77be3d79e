// The ways of asking Embree. Rays lie ready in the form that each of them takes, and are copied, for Embree answers in
// place; packets are spared the turning of rays into arrays of lanes.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <string>
#include <vector>

#include "bench/contender.h"

namespace limn::bench {

std::vector<std::unique_ptr<Subject>> embree_subjects(const std::string& name, RTCScene scene);

}  // namespace limn::bench
