// A parallel loop over the rows of an array that Ctrl-C can end.
#pragma once

#include <nanobind/nanobind.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace limn::python {

// The number of rows that are converted and traced together. They fit into the cache.
inline constexpr std::size_t kPart = 1024;
// The number of rows after which signals are checked.
inline constexpr std::size_t kMostRows = 1 << 20;

// Calls work(first, count) for all rows, in parts of up to kPart rows, on `threads` threads; 0 uses all threads of the
// machine. Releases the GIL while it works. Throws what a signal handler raises. \pre the GIL is held
template <class Work>
void for_all_rows(std::size_t rows, int threads, const Work& work) {
    // Works on the rows from begin to end.
    const auto some = [&](std::size_t begin, std::size_t end) {
        const std::size_t parts = (end - begin + kPart - 1) / kPart;
        const auto one = [&](std::size_t part) {
            const std::size_t first = begin + part * kPart;
            work(first, std::min(kPart, end - first));
        };
        if (threads == 1 || parts == 1) {
            for (std::size_t part = 0; part < parts; ++part) one(part);
            return;
        }
        const auto all = [&] { tbb::parallel_for(std::size_t{0}, parts, one); };
        if (threads == 0) return all();
        // TBB limits threads to the number of processors. Raise the limit if more threads are asked for.
        using tbb::global_control;
        constexpr auto kMost = global_control::max_allowed_parallelism;
        const global_control allow(kMost,
                                   std::max(static_cast<std::size_t>(threads), global_control::active_value(kMost)));
        tbb::task_arena(threads).execute(all);
    };
    // Work on kMostRows rows at a time, and check for signals after each.
    for (std::size_t begin = 0; begin < rows; begin += kMostRows) {
        {
            const nanobind::gil_scoped_release release;
            some(begin, std::min(rows, begin + kMostRows));
        }
        if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
    }
}

}  // namespace limn::python
