/// \file
/// The measurements of `limn bench`. For each scene it measures building and then the rays of each kind. The contenders
/// take turns in each round, so that other load of the machine affects all of them alike.
#pragma once

#include <functional>
#include <span>

#include "bench/contender.h"
#include "json_output.h"

namespace limn::bench {

// The times and the results of a subject for a set of rays.
struct Timing {
    std::string subject;
    std::vector<double> seconds{};  // the time of each round
    std::size_t mismatches = 0;     // rays that differ from the first subject by hit or miss, or by over 1/1000 of t
    std::size_t differences = 0;    // rays that differ from the first subject in any bit of the result
};

// The median and the lower and upper quartile of some numbers.
struct Spread {
    double median = 0, low = 0, high = 0;
};
Spread spread_of(std::vector<double> values);

// Returns the spread over the rounds of the time of b divided by the time of a.
Spread ratio(const Timing& a, const Timing& b);

// Traces the set once with each subject and compares the results with those of the first subject. Then traces it
// `rounds` times with each and takes the time. Ends early if `keep_going` returns false.
std::vector<Timing> measure(std::span<const std::unique_ptr<Subject>> subjects, const RaySet& set, int threads,
                            int rounds, const std::function<bool()>& keep_going);

// The options of `limn bench`.
struct Plan {
    std::vector<std::string> scenes;          // names that make_scene accepts
    std::vector<std::string> models;          // paths of OBJ files
    double scale = 1;                         // factor of the number of primitives of `scenes`
    std::size_t rays = std::size_t{1} << 18;  // number of rays of each kind
    std::vector<std::string> kinds;           // kinds of rays; empty: all
    int rounds = 7;                           // number of times that the rays are traced
    int build_rounds = 3;                     // number of times that the scene is built; 0: building is not measured
    std::vector<int> threads;                 // numbers of threads
};

struct Results {
    std::string table;  // text for the terminal
    app::Json json = app::Json::object();
    std::string fault;  // the rays for which limn's batches and single rays differ; empty if they never do
};

// run_session calls a Watch after each measurement with the part of the plan that is done. False ends the session.
using Watch = std::function<bool(double)>;

// Measures what the plan says. Returns the results so far if `watch` ends the session.
Results run_session(const Plan& plan, const std::vector<Contender>& contenders, const Watch& watch);

}  // namespace limn::bench
