/// \file
#pragma once

#include "bench/contender.h"
#include "limn/render/render.h"

namespace limn::bench {

class LimnScene final : public BuiltScene {
public:
    // The description is not timed: it copies what a program has into the form that limn takes.
    explicit LimnScene(const Scene& scene, Clock clock = Clock::wall);

    double seconds() const override { return seconds_; }
    std::size_t bytes() const override { return scene_.stats().memory_bytes; }
    // "limn" traces ray by ray, "limn batch" spans of some thousand rays, "limn whole" much longer ones.
    std::vector<std::unique_ptr<Subject>> subjects() const override;
    const CompiledScene& compiled() const { return scene_; }

private:
    Stopwatch watch_;
    CompiledScene scene_;
    double seconds_;
};

class LimnContender final : public Contender {
public:
    std::string name() const override { return "limn"; }
    std::string version() const override { return limn::version(); }
    std::unique_ptr<BuiltScene> build(const Geometry& geometry, Clock clock) const override;
};

}  // namespace limn::bench
