/// \file
/// What `limn bench` measures: scene by scene, the building and then the rays of each kind. In each round all renderers
/// take their turn, so that other load of the machine falls on all alike.
#pragma once

#include <functional>
#include <span>

#include "bench/contender.h"
#include "json_output.h"

namespace limn::bench {

struct Timing {
    std::string subject;
    std::vector<double> seconds{};  // one a round
    // The number of rays that differ from the first subject: by hit or miss or by a thousandth of t, and by any bit.
    std::size_t mismatches = 0, differences = 0;
};

// The median and quartiles of some numbers.
struct Spread {
    double median = 0, low = 0, high = 0;
};
Spread spread_of(std::vector<double> values);

// How much faster a is than b, round by round.
Spread ratio(const Timing& a, const Timing& b);

// Traces the set with each subject once and compares the results with those of the first subject. Then traces it
// `rounds` times and takes the time. Measures fewer rounds, or none, if `keep_going` returns false.
std::vector<Timing> measure(std::span<const std::unique_ptr<Subject>> subjects, const RaySet& set, int threads,
                            int rounds, const std::function<bool()>& keep_going);

struct Plan {
    std::vector<std::string> scenes;  // names that make_scene knows
    std::vector<std::string> models;  // files
    double scale = 1;
    std::size_t rays = std::size_t{1} << 18;
    std::vector<std::string> kinds;  // of rays; empty: all
    int rounds = 7;
    int build_rounds = 3;
    std::vector<int> threads;
};

struct Results {
    std::string table;
    app::Json json = app::Json::object();
    std::string fault;  // says where batches and single rays of limn have different results; empty: nowhere
};

// Is given the share of the plan that is done after each measurement. Returns false to stop.
using Watch = std::function<bool(double)>;

// Returns the results so far if it is stopped.
Results run_session(const Plan& plan, const std::vector<Contender>& contenders, const Watch& watch);

}  // namespace limn::bench
