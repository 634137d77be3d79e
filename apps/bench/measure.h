/// \file
/// Rounds in which all renderers take turns, so that other load of the machine falls on all alike.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/contender.h"

namespace limn::bench {

struct Timing {
    std::string subject;
    std::vector<double> seconds;  // one a round
    std::size_t mismatches = 0;   // rays that differ from limn: hit or miss, or t by more than a thousandth
};

// The median and quartiles of several numbers, one a round.
struct Spread {
    double median = 0, low = 0, high = 0;
};
Spread spread_of(std::vector<double> values);

// How much faster a is than b, round by round.
Spread ratio(const Timing& a, const Timing& b);

// Returns false to stop.
using KeepGoing = std::function<bool()>;

// Traces the set with each subject once for its results, and then `rounds` times. The results of the others are
// compared with those of the first subject. Fewer rounds, or none, if it is to stop.
std::vector<Timing> measure(std::span<const std::unique_ptr<Subject>> subjects, const RaySet& set, int threads,
                            int rounds, const KeepGoing& keep_going);

// For how many rays `a` and `b` have different bits. \pre both have traced the set
std::size_t differences(const Subject& a, const Subject& b, std::size_t rays);

}  // namespace limn::bench
