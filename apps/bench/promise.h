/// \file
/// limn's estimate of its own error, measured: scenes, references, and single renders against their reference.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "limn/limn.h"

namespace limn::bench {

/// A picture whose error is known, by two independent halves of a reference.
struct Subject {
    std::string name;
    CompiledScene scene;
    Camera camera;
    int size = 64;      ///< pixels a side
    double finest = 0;  ///< the least relMSE that it is rendered to; the reference's is an eighth of it in each half
    Image a{}, b{};     ///< the reference
};

/// The first ten scenes of the convergence report, and "bouncing", "glass" and "fireflies".
const std::vector<std::string>& subject_names();
/// Without reference. \throws ArgumentError for another name
Subject subject_of(const std::string& name);
void render_reference(Subject& subject);

/// What a render knew of its error, and what that was.
struct Known {
    std::uint64_t seed = 0;
    double samples = 0;   ///< a pixel
    double estimate = 0;  ///< of its relMSE; NaN where there is none
    double lower = 0;     ///< ends of the interval of that
    double upper = 0;     ///< \copydoc lower
    double error = 0;     ///< measured, the reference's own subtracted
    double fewest = 0;    ///< samples at which the error meets the target; 0: not looked for, or never
    double halves = 0;    ///< error of the mean of two renders of half as many samples; 0: not measured
};

/// Of so many samples in each pixel.
Known known_after(const Subject& subject, int samples, std::uint64_t seed);

/// Of a render to a target, on one thread. If `compare`, the fewest samples that meet the target are looked for by
/// bisection, to within 2 % or two samples, and so is what two replicates more would cost: the mean of two renders is
/// one with twice as many.
Known known_at_stop(const Subject& subject, double target, std::uint64_t seed, bool compare);

}  // namespace limn::bench
