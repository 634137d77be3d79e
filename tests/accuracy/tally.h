// Counts, added up over chunks of rays that any thread may take: sums and maxima, so that threads change nothing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "support/exact_truth.h"

namespace limn::accuracy {

// One competitor in one row.
struct Cell {
    std::uint64_t asked = 0;  // all rays of the row, but where they end the competitor's process
    std::uint64_t false_hits = 0, false_misses = 0;
    std::uint64_t self_hits = 0, lost = 0;  // leaving a surface: hit again; passed through what is behind
    std::uint64_t aborts = 0;
    double t_ulps = 0;   // largest error of t, in units of 2^-23 of it
    double uv_ulps = 0;  // of u and v, in units of 2^-23
    double figure = 0;   // what else the row states, and its standard error
    double figure_error = 0;

    void add(const Cell& other);
};

struct Row {
    std::string name;
    std::uint64_t rays = 0, judged = 0;
    std::vector<Cell> cells;  // a column each
    double x = 0;             // where plots put it

    void add(const Row& other);
};

// What a cell states: see apps/bench/accuracy.py.
struct Group {
    std::string key, measure;
    std::vector<std::string> columns;
    std::vector<Row> rows;
};

// Counts per million or absolute, how many rays each row gets, how to divide the work.
struct Effort {
    std::uint64_t rays = 1'000'000;       // an ordinary row
    std::uint64_t leak_rays = 1'000'000;  // a row of leaks
    unsigned threads = 0;                 // 0: all processors
};

// The seed of chunk `chunk` of row `row`: neighbouring ones have nothing in common.
std::uint64_t seed_of(const std::string& row, std::uint64_t chunk);

// Adds up work(chunk, first, count, sum) over consecutive chunks of at most `size` of `rays` rays. `sum` begins as
// `empty` in each thread, which makes its own `work` by maker().
using Work = std::function<void(std::uint64_t chunk, std::size_t count, Row& sum)>;
Row add_up(const Row& empty, std::uint64_t rays, std::size_t size, unsigned threads,
           const std::function<Work()>& maker);

// The error of t against its truth, in units of 2^-23 of that, and that of u or v, in units of 2^-23: never NaN.
double ulps(double t, test::Real truth);
double in_ulps_of_1(test::Real error);

}  // namespace limn::accuracy
