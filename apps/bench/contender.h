/// \file
/// The renderers that are measured: limn, and those of modules.
#pragma once

#include <time.h>

#include <memory>
#include <string>
#include <vector>

#include "bench/scenes.h"

namespace limn::bench {

// What one thread does is measured by the processor's time that it takes, so that other programs count less. What
// several threads do is measured by the time that passes.
enum class Clock { wall = CLOCK_MONOTONIC, process = CLOCK_PROCESS_CPUTIME_ID, thread = CLOCK_THREAD_CPUTIME_ID };

// Returns the time of a clock.
inline double seconds(Clock clock) {
    timespec time{};
    clock_gettime(static_cast<clockid_t>(clock), &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The result of a ray. A ray that only asks whether there is a hit has t = 0 for a hit, and nothing else.
struct Answer {
    double t = kInfinity;  // a miss
    double u = 0, v = 0;
    std::uint64_t primitive = 0;
    bool operator==(const Answer&) const = default;
};

// One way to trace rays in a built scene. Only trace() is timed: it reads rays that prepare() has put into memory in
// the form that suits the renderer, and leaves results in memory.
class Subject {
public:
    explicit Subject(std::string subject_name) : name(std::move(subject_name)) {}
    virtual ~Subject() = default;
    virtual void prepare(const RaySet& set) = 0;  // `set` lives until the next call
    // Several threads may trace parts that do not overlap. `first` is a multiple of 64.
    virtual void trace(std::size_t first, std::size_t count) = 0;
    virtual Answer answer(std::size_t i) const = 0;

    const std::string name;
};

// A scene that a contender has built. The subjects keep it alive.
struct BuiltScene {
    double seconds = 0;     // time of building
    std::size_t bytes = 0;  // memory of the scene, including arrays that limn shares with the geometry
    std::vector<std::unique_ptr<Subject>> subjects;  // single rays first
};

struct Contender {
    std::string name, version;
    BuiltScene (*build)(const Geometry& geometry, Clock clock);  // the geometry outlives the scene
};
BuiltScene build_limn(const Geometry& geometry, Clock clock);

// limn, and the contenders of the module limn_bench_embree (common/module.h). `notes` says why one is missing.
std::vector<Contender> load_contenders(std::vector<std::string>& notes);

// The type of a module's limn_module.
using AddContenders = void(std::vector<Contender>&);

}  // namespace limn::bench
