/// \file
/// What `limn bench` does: scene by scene, builds, rays, rounds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/measure.h"

namespace limn::bench {

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

// Rays of one kind, by some number of threads.
struct RayRow {
    std::string rays;
    std::size_t count = 0;
    bool any = false;
    int threads = 1;
    std::vector<Timing> timings;
    std::size_t differences = 0;  // between limn's single rays and its batches, of all sizes together

    const Timing* find(const std::string& subject) const;
    // The fastest by its median, among limn's batches or Embree's modes for many rays at once; none if there is none.
    const Timing* best_batch() const;
    const Timing* best_peer() const;
    double million_a_second(const Timing& timing) const;
};

struct BuildRow {
    int threads = 1;
    std::vector<Timing> timings;
};

struct SceneResult {
    std::string name;
    std::size_t primitives = 0;
    std::vector<std::pair<std::string, std::size_t>> bytes;  // by contender
    std::vector<BuildRow> builds;
    std::vector<RayRow> rows;
};

// Gets the share of the plan that is done after each measurement; returns false to stop.
using Watch = std::function<bool(double)>;

// The results as far as they went.
std::vector<SceneResult> run_session(const Plan& plan, const std::vector<std::shared_ptr<const Contender>>& peers,
                                     const Watch& watch);

}  // namespace limn::bench
