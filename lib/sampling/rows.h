// Numbers of many paths, one after the other: rows that stages read and write.
#pragma once

#include <cstddef>
#include <cstdint>

#include "limn/core/color.h"

namespace limn::sampling {

// As many paths as are shaded together: a multiple of every vector's lanes, few enough for the first cache; and as many
// as are traced together, so that their state fits the second one.
inline constexpr std::size_t kShaded = 32, kBatch = 512;
// Beyond a batch, where vectors are stored of which only the first lanes count.
inline constexpr std::size_t kSlack = 16;

template <std::size_t n>
struct Rows3Of {
    alignas(64) double x[n] = {};
    double y[n] = {}, z[n] = {};

    // Of a point, direction or normal.
    template <class Three>
    void set(std::size_t i, const Three& v) {
        x[i] = v.x, y[i] = v.y, z[i] = v.z;
    }
    void set(std::size_t i, const Color& c) { x[i] = c.r, y[i] = c.g, z[i] = c.b; }
    template <class Three>
    Three get(std::size_t i) const {
        return {x[i], y[i], z[i]};
    }
};

using Row = double[kShaded];
using Rows3 = Rows3Of<kShaded>;

// Who a path is, and what it carries.
template <std::size_t n>
struct PathRows {
    std::uint32_t path[n] = {};    // in the batch
    std::uint32_t vertex[n] = {};  // the next one, from 1 on
    std::uint64_t base[n] = {};    // of its Sobol sequence: see Sampler in render/sampler.h
    std::uint32_t index[n] = {};   // of its point
    double time[n] = {};           // in shutter units
    Rows3Of<n> throughput;

    // Row i becomes row `at` of other rows, but for the throughput; and, for `follow`, one vertex on.
    template <std::size_t m>
    void copy(std::size_t i, const PathRows<m>& from, std::size_t at) {
        path[i] = from.path[at], vertex[i] = from.vertex[at];
        base[i] = from.base[at], index[i] = from.index[at];
        time[i] = from.time[at];
    }
    template <std::size_t m>
    void follow(std::size_t i, const PathRows<m>& from, std::size_t at) {
        copy(i, from, at);
        ++vertex[i];
    }
};

}  // namespace limn::sampling
