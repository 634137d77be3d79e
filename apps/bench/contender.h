/// \file
/// The ray tracers that are measured: limn, and those that modules add.
#pragma once

#include <time.h>

#include <memory>
#include <string>
#include <vector>

#include "bench/scenes.h"

namespace limn::bench {

// One thread is measured in processor time, which other programs affect less. Several are measured in wall time.
enum class Clock { wall = CLOCK_MONOTONIC, process = CLOCK_PROCESS_CPUTIME_ID, thread = CLOCK_THREAD_CPUTIME_ID };

inline double seconds(Clock clock) {
    timespec time{};
    clock_gettime(static_cast<clockid_t>(clock), &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// One way to trace rays in a built scene: single rays, packets or batches. Only trace() is timed. prepare() converts
// the rays to the form that the ray tracer takes. trace() reads them and stores the results.
class Subject {
public:
    explicit Subject(std::string subject_name) : name(std::move(subject_name)) {}
    virtual ~Subject() = default;
    // Takes the rays to trace. `set` must live until the next call.
    virtual void prepare(const RaySet& set) = 0;
    // Traces `count` rays from `first` on, a multiple of 64. Several threads may trace parts that do not overlap.
    virtual void trace(std::size_t first, std::size_t count) = 0;
    // Returns the result of ray i, whose t is infinite for a miss and 0 for an any-hit query that hits. The contenders
    // are compared by t alone. \pre the ray has been traced
    virtual RayHit answer(std::size_t i) const = 0;

    const std::string name;
};

// A scene that a contender has built. The subjects keep it alive.
struct BuiltScene {
    double seconds = 0;                              // time of building
    std::size_t bytes = 0;                           // memory, including arrays that limn shares with the geometry
    std::vector<std::unique_ptr<Subject>> subjects;  // the first one traces single rays
};

struct Contender {
    std::string name, version;
    // Builds a scene and takes the time by the clock. The geometry must outlive the scene.
    BuiltScene (*build)(const Geometry& geometry, Clock clock);
};
// Builds a scene with limn. See Contender::build.
BuiltScene build_limn(const Geometry& geometry, Clock clock);

// Returns limn and the contenders of the module limn_bench_embree. Adds a note if the module can't be loaded.
std::vector<Contender> load_contenders(std::vector<std::string>& notes);

}  // namespace limn::bench
