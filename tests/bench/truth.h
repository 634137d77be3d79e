// limn's answers to the rays of `limn bench` against exact truth, by brute force over every primitive.
#pragma once

#include <string>

#include "bench/scenes.h"

namespace limn::test {

struct Verdict {
    std::size_t rays = 0, hits = 0, wrong = 0;
    std::string first;  // what is wrong with the first that is
};

// Of some `sample` rays, evenly out of the set: whether there is a hit, and its t within an ulp of a float32.
Verdict judge(const bench::Geometry& geometry, const CompiledScene& scene, const bench::RaySet& set,
              std::size_t sample);

}  // namespace limn::test
