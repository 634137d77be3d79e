// The ways to trace with Embree. Rays are ready in the form that each of them takes, and are copied, because Embree
// writes results in place. Packets are not charged for the conversion of rays to arrays of lanes.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <string>
#include <vector>

#include "bench/contender.h"

namespace limn::bench {

std::vector<std::unique_ptr<Subject>> embree_subjects(const std::string& name, RTCScene scene);

}  // namespace limn::bench
