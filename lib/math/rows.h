// Rows: arrays with one number for each of many paths. The stages of path tracing read and write them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "limn/math/color.h"

namespace limn::sampling {

// The number of paths that are shaded together. It is a multiple of the number of lanes of every vector, and small
// enough for the first-level cache.
inline constexpr std::size_t kShaded = 32;
// The number of paths that are traced together. Their state fits the second-level cache.
inline constexpr std::size_t kBatch = 512;
// The number of spare elements behind a batch. Stages store whole vectors of which only the first lanes are valid; the
// other lanes are stored there.
inline constexpr std::size_t kSlack = 16;

// Three rows of n numbers: the coordinates of n points, directions or normals, or n colours.
template <std::size_t n>
struct Rows3Of {
    alignas(64) double x[n] = {};
    double y[n] = {}, z[n] = {};

    // Sets element i to a point, direction or normal.
    template <class Three>
    void set(std::size_t i, const Three& v) {
        x[i] = v.x;
        y[i] = v.y;
        z[i] = v.z;
    }
    void set(std::size_t i, const Color& c) {
        x[i] = c.r;
        y[i] = c.g;
        z[i] = c.b;
    }
    // Returns element i as a point, direction, normal or colour.
    template <class Three>
    Three get(std::size_t i) const {
        return {x[i], y[i], z[i]};
    }
};

using Row = double[kShaded];
using Rows3 = Rows3Of<kShaded>;

// The state of n paths: their numbers, their position in the Sobol sequence, time and throughput.
template <std::size_t n>
struct PathRows {
    std::uint32_t path[n] = {};    // number of the path in the batch
    std::uint32_t vertex[n] = {};  // number of the path's next vertex; the first is 1
    std::uint64_t base[n] = {};    // Sampler::base() (render/sampler.h): identifies the Sobol sequence
    std::uint32_t index[n] = {};   // Sampler::index(): identifies the point of the sequence
    double time[n] = {};           // in shutter units
    Rows3Of<n> throughput;

    // Copies row `at` of `from` to row i, except for the throughput.
    template <std::size_t m>
    void copy(std::size_t i, const PathRows<m>& from, std::size_t at) {
        path[i] = from.path[at];
        vertex[i] = from.vertex[at];
        base[i] = from.base[at];
        index[i] = from.index[at];
        time[i] = from.time[at];
    }
    // Copies a row as copy() does and advances its path to the next vertex.
    template <std::size_t m>
    void follow(std::size_t i, const PathRows<m>& from, std::size_t at) {
        copy(i, from, at);
        ++vertex[i];
    }
};

}  // namespace limn::sampling
