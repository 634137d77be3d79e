/// \file
/// What a loadable module of `limn bench` gives: somebody to compare with. Nothing else of limn's links those
/// libraries.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/contender.h"

namespace limn::bench {

// The contenders that modules bring (common/module.h); none where a module is not there. In `notes`: why not.
std::vector<std::shared_ptr<const Contender>> load_peers(std::vector<std::string>& notes);

// What a module exports, as limn_module.
using PeerList = void(std::vector<std::shared_ptr<const Contender>>&);

}  // namespace limn::bench
