// Random numbers that depend on nothing but (seed, pixel, sample, dimension).
#pragma once

#include <Random123/philox.h>

#include <cstdint>

#include "limn/core/surface.h"
#include "limn/core/vec.h"

namespace limn::tracing {

// The dimensions of one sample, in order. Philox4x64-10: Salmon et al., Parallel Random Numbers: As Easy as 1, 2, 3,
// 2011. 53 bits a number, so that a free path can be longer than 24 bits allow.
class Sampler {
public:
    Sampler(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample)
        : key_{{seed, 0}}, counter_{{pixel, sample, 0, 0}} {}

    // In [0, 1).
    double next() {
        if (used_ == 4) refill();
        return static_cast<double>(block_[used_++] >> 11) * 0x1p-53;
    }
    Uv next_2d() {
        const double u = next();
        return {u, next()};
    }
    Random3 next_3d() {
        const double x = next(), y = next();
        return {x, y, next()};
    }

private:
    void refill() {
        block_ = r123::Philox4x64{}(counter_, key_);
        ++counter_[2];
        used_ = 0;
    }

    r123::Philox4x64::key_type key_;
    r123::Philox4x64::ctr_type counter_, block_{};
    unsigned used_ = 4;
};

}  // namespace limn::tracing
