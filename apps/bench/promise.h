/// \file
/// Whether a render to an error keeps what it promises: scenes, references, and one render beside its reference.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "limn/limn.h"

namespace limn::bench {

/// A picture and the relMSE to render it to.
struct Promise {
    std::string name;
    CompiledScene scene;
    Camera camera;
    double target = 0;
    int size = 64;  ///< pixels a side
};

/// "cornell", "bouncing", "glass", "smoke", "fireflies".
const std::vector<std::string>& promise_names();
/// \throws ArgumentError for another name
Promise promise_of(const std::string& name);

/// Two independent halves, each to a sixteenth of the target: their mean has an error of at most a thirtieth.
struct Reference {
    Image a, b;
};
Reference reference_of(const Promise& promise);

/// How a render to the target ended.
struct Stop {
    std::uint64_t seed = 0;
    double samples = 0;   ///< a pixel
    double estimate = 0;  ///< of its relMSE
    double upper = 0;     ///< end of the interval of that
    double error = 0;     ///< measured, the reference's own subtracted
    double fewest = 0;    ///< samples at which the error meets the target; 0: not looked for, or never
    double seconds = 0;
};

/// Renders on one thread. The fewest samples are looked for by bisection, to within 2 %, which takes some more renders.
Stop stop_of(const Promise& promise, const Reference& reference, std::uint64_t seed, bool look_for_fewest);

}  // namespace limn::bench
