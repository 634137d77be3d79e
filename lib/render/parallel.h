// Parallel loops and the TBB arena of a render.
#pragma once

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <atomic>
#include <cstddef>

#include "math/float_environment.h"
#include "query/threads.h"

namespace limn::transport {

/// Calls function(0) ... function(count - 1), each once, on the threads of the caller's TBB arena. No further call is
/// made once the context is cancelled. An exception in a call cancels the context and is rethrown here.
///
/// The threads take their indices from one relaxed counter. oneTBB synchronises the calls with the code before and
/// after the loop.
template <class Function>
void for_each_index(std::size_t count, tbb::task_group_context& context, const Function& function) {
    std::atomic<std::size_t> next = 0;
    const auto work = [&next, &function, &context, count](int) {
        const FloatEnvironment environment;  // threads of the caller's arena may have another one
        for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) {
            if (context.is_group_execution_cancelled()) return;
            function(i);
        }
    };
    tbb::parallel_for(0, tbb::this_task_arena::max_concurrency(), work, tbb::simple_partitioner{}, context);
}

/// Calls function(0) ... function(height - 1) on the threads of the caller's TBB arena. All calls are made even if the
/// render that calls this is cancelled.
template <class Function>
void for_each_row(int height, const Function& function) {
    tbb::task_group_context context(tbb::task_group_context::isolated);
    for_each_index(static_cast<std::size_t>(height), context, [&](std::size_t y) { function(static_cast<int>(y)); });
}

/// Calls function() in a TBB arena of `threads` threads, or in the caller's arena if `threads` is 0.
template <class Function>
void with_threads(int threads, const Function& function) {
    const FloatEnvironment environment;
    query::with_threads(threads, function);
}

}  // namespace limn::transport
