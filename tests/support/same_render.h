// What two runs of one render must share, in every bit.
#pragma once

#include "catch.h"
#include "limn/render/render.h"

namespace limn::test {

/// Pixels, channels, estimate, samples, rays; not times, threads and memory.
inline void check_same(const RenderResult& a, const RenderResult& b) {
    CHECK(a.image == b.image);
    CHECK(a.maps.samples == b.maps.samples);
    CHECK(a.maps.error == b.maps.error);
    CHECK(a.error.reason == b.error.reason);
    if (a.error.reason.empty()) {
        CHECK(a.error.estimate == b.error.estimate);
        CHECK(a.error.ci95_low == b.error.ci95_low);
        CHECK(a.error.ci95_high == b.error.ci95_high);
    }
    CHECK(a.error.max_sample_share == b.error.max_sample_share);
    CHECK(a.report.samples_per_pixel == b.report.samples_per_pixel);
    CHECK(a.report.rays == b.report.rays);
    CHECK(a.report.nonfinite_samples == b.report.nonfinite_samples);
}

}  // namespace limn::test
