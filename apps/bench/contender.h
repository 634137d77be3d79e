/// \file
/// The renderers that are measured: limn, and the peers of modules (see peer_module.h).
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/rays.h"
#include "bench/stopwatch.h"

namespace limn::bench {

// The result of a ray. For any-hit rays t alone counts: 0 for a hit.
struct Answer {
    double t = kInfinity;  // a miss
    double u = 0, v = 0;
    std::uint64_t primitive = 0;
    bool operator==(const Answer&) const = default;
};

// One way to trace rays in a built scene. What is measured is trace(): from rays that are ready in memory, in whatever
// form suits, to results in memory.
class Subject {
public:
    explicit Subject(std::string name, std::size_t chunk = 4096) : name_(std::move(name)), chunk_(chunk) {}
    virtual ~Subject() = default;
    Subject(const Subject&) = delete;
    Subject& operator=(const Subject&) = delete;

    const std::string& name() const { return name_; }
    std::size_t chunk() const { return chunk_; }  // how many rays it likes to be given at a time

    virtual void prepare(const RaySet& set) = 0;  // `set` stays until the next
    // Several threads may do so for parts that do not overlap; `first` is a multiple of 64.
    virtual void trace(std::size_t first, std::size_t count) = 0;
    virtual Answer answer(std::size_t i) const = 0;

private:
    std::string name_;
    std::size_t chunk_;
};

class BuiltScene {
public:
    virtual ~BuiltScene() = default;
    virtual double seconds() const = 0;     // that building took, by the clock that build() was given
    virtual std::size_t bytes() const = 0;  // that it holds, the arrays that it shares with the geometry included
    virtual std::vector<std::unique_ptr<Subject>> subjects() const = 0;  // valid as long as this
};

class Contender {
public:
    virtual ~Contender() = default;
    virtual std::string name() const = 0;
    virtual std::string version() const = 0;
    // \param geometry stays as long as the scene
    virtual std::unique_ptr<BuiltScene> build(const Geometry& geometry, Clock clock) const = 0;
};

}  // namespace limn::bench
