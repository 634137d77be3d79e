// Rows: arrays with one number for each of many paths. The stages of path tracing read and write them.
//
// The state of n paths is a struct of such arrays, its columns. Its function each_column(a, b, f) lists them: it calls
// f(column of a, the same column of b) for each. Copies follow from this list: see copy_row().
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

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

    static constexpr void each_column(auto& a, auto& b, const auto& f) {
        f(a.x, b.x);
        f(a.y, b.y);
        f(a.z, b.z);
    }

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

// Returns the size of the columns of Rows<16> that each_column() lists.
template <template <std::size_t> class Rows>
consteval std::size_t size_of_columns() {
    std::size_t size = 0;
    Rows<16> rows;
    Rows<16>::each_column(rows, rows, [&size](auto& column, auto&) { size += sizeof(column); });
    return size;
}

// Copies element `at` of each column of `from` to element i of `to`. If the arguments are structs derived from Rows,
// only the columns of Rows are copied.
template <template <std::size_t> class Rows, std::size_t n, std::size_t m>
inline void copy_row(Rows<n>& to, std::size_t i, const Rows<m>& from, std::size_t at) {
    static_assert(size_of_columns<Rows>() == sizeof(Rows<16>), "each_column() must list every column");
    Rows<n>::each_column(to, from, [i, at](auto& column, const auto& source) {
        if constexpr (std::is_array_v<std::remove_reference_t<decltype(column)>>)
            column[i] = source[at];
        else
            copy_row(column, i, source, at);
    });
}

// The state of n paths: their numbers, their position in the Sobol sequence, and time.
template <std::size_t n>
struct PathRows {
    alignas(64) std::uint32_t path[n] = {};  // number of the path in the batch
    std::uint32_t vertex[n] = {};            // number of the path's next vertex; the first is 1
    std::uint64_t base[n] = {};              // Sampler::base() (render/sampler.h): identifies the Sobol sequence
    std::uint32_t index[n] = {};             // Sampler::index(): identifies the point of the sequence
    double time[n] = {};                     // in shutter units

    static constexpr void each_column(auto& a, auto& b, const auto& f) {
        f(a.path, b.path);
        f(a.vertex, b.vertex);
        f(a.base, b.base);
        f(a.index, b.index);
        f(a.time, b.time);
    }
};

}  // namespace limn::sampling
