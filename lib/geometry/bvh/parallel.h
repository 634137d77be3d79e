// Parallel loops, and the number of threads that they use.
#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace limn::accel {

// Calls function(i) for all i in [begin, end), in parallel. A task has about `grain` calls or more. The caller's thread
// makes the calls itself if there are no more than `grain`.
template <class Function>
void for_all(std::size_t begin, std::size_t end, std::size_t grain, const Function& function) {
    const auto run = [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) function(i);
    };
    const tbb::blocked_range<std::size_t> all(begin, end, grain);
    if (all.is_divisible())
        tbb::parallel_for(all, run);
    else
        run(all);
}

// Calls function() with `threads` threads, which may be more than there are processors. If `threads` is 0, the threads
// of the caller's arena are used.
template <class Function>
void with_threads(int threads, const Function& function) {
    if (threads == 0) return function();
    const auto count = static_cast<std::size_t>(threads);
    using tbb::global_control;
    const global_control allow(global_control::max_allowed_parallelism,
                               std::max(count, global_control::active_value(global_control::max_allowed_parallelism)));
    tbb::task_arena arena(threads);
    arena.execute(function);
}

}  // namespace limn::accel
