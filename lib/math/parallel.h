// Parallel loops, and the number of threads that they use. The threads of an arena may have any floating-point
// environment. Therefore every function here gives the code that it calls a FloatEnvironment.
#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "math/float_environment.h"

namespace limn {

// Calls function(i) for all i in [begin, end), in parallel. A task has about `grain` calls or more. The caller's thread
// makes the calls itself if there are no more than `grain`. All calls are made even if the caller's task group is
// cancelled.
template <class Function>
void for_all(std::size_t begin, std::size_t end, std::size_t grain, const Function& function) {
    const auto run = [&](const tbb::blocked_range<std::size_t>& range) {
        const FloatEnvironment environment;
        for (std::size_t i = range.begin(); i < range.end(); ++i) function(i);
    };
    const tbb::blocked_range<std::size_t> all(begin, end, grain);
    if (!all.is_divisible()) return run(all);
    tbb::task_group_context context(tbb::task_group_context::isolated);
    tbb::parallel_for(all, run, context);
}

// Returns the join of the results of add(result, i) for all i in [0, count), in parallel, as for_all() does. Each task
// starts with a default-constructed result.
template <class Result, class Add, class Join>
Result join_all(std::size_t count, std::size_t grain, const Add& add, const Join& join) {
    using Range = tbb::blocked_range<std::size_t>;
    tbb::task_group_context context(tbb::task_group_context::isolated);
    const auto run = [&](const Range& range, Result result) {
        const FloatEnvironment environment;
        for (std::size_t i = range.begin(); i < range.end(); ++i) add(result, i);
        return result;
    };
    return tbb::parallel_reduce(Range(0, count, grain), Result{}, run, join, context);
}

// Calls function(0) ... function(height - 1) in parallel, as for_all() does.
template <class Function>
void for_each_row(int height, const Function& function) {
    for_all(0, static_cast<std::size_t>(height), 1, [&](std::size_t y) { function(static_cast<int>(y)); });
}

// Calls function(0) ... function(count - 1), each once, in parallel and about in this order. No further call is made
// once the context is cancelled. An exception in a call cancels the context and is rethrown here.
//
// The threads take their indices from one relaxed counter. oneTBB synchronises the calls with the code before and
// after the loop.
template <class Function>
void for_each_until_cancelled(std::size_t count, tbb::task_group_context& context, const Function& function) {
    std::atomic<std::size_t> next = 0;
    const auto work = [&next, &function, &context, count](int) {
        const FloatEnvironment environment;
        for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) {
            if (context.is_group_execution_cancelled()) return;
            function(i);
        }
    };
    tbb::parallel_for(0, tbb::this_task_arena::max_concurrency(), work, tbb::simple_partitioner{}, context);
}

// Returns function(), called with `threads` threads, which may be more than there are processors. If `threads` is 0,
// the threads of the caller's arena are used.
template <class Function>
auto with_threads(int threads, const Function& function) {
    const auto run = [&] {
        const FloatEnvironment environment;
        return function();
    };
    if (threads == 0) return run();
    const auto count = static_cast<std::size_t>(threads);
    using tbb::global_control;
    const global_control allow(global_control::max_allowed_parallelism,
                               std::max(count, global_control::active_value(global_control::max_allowed_parallelism)));
    tbb::task_arena arena(threads);
    return arena.execute(run);
}

}  // namespace limn
