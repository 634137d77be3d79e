/// \file
/// What a loadable module of `limn bench` provides: a renderer to compare with. Nothing else of limn links those
/// libraries.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/contender.h"

namespace limn::bench {

// The contenders of modules (common/module.h); none if a module is missing. `notes` says why.
std::vector<std::shared_ptr<const Contender>> load_peers(std::vector<std::string>& notes);

// What a module exports, as limn_module.
using PeerList = void(std::vector<std::shared_ptr<const Contender>>&);

}  // namespace limn::bench
