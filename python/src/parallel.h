// Work on many rows, on several threads, that Ctrl-C can end.
#pragma once

#include <nanobind/nanobind.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace limn::python {

inline constexpr std::size_t kPart = 1024;  // rows that are converted and traced together: they stay in the cache
inline constexpr std::size_t kMostRows = 1 << 20;  // between looks for Ctrl-C

// work(first, count) for all rows, on `threads` of them; 0: on all of the machine. Lets the interpreter's lock go.
template <class Work>
void for_all_rows(std::size_t rows, int threads, const Work& work) {
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
        // More than there are processors are allowed, for whoever asks for them.
        using tbb::global_control;
        constexpr auto kMost = global_control::max_allowed_parallelism;
        const global_control allow(kMost,
                                   std::max(static_cast<std::size_t>(threads), global_control::active_value(kMost)));
        tbb::task_arena(threads).execute(all);
    };
    for (std::size_t begin = 0; begin < rows; begin += kMostRows) {
        {
            const nanobind::gil_scoped_release release;
            some(begin, std::min(rows, begin + kMostRows));
        }
        if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
    }
}

}  // namespace limn::python
