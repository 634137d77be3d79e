// How a render uses threads: the loop that it runs in parallel, and in which arena.
#pragma once

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <atomic>
#include <cstddef>

#include "core/float_environment.h"
#include "query/threads.h"

namespace limn::transport {

/// Calls function(0) ... function(count - 1), each once, on the threads of the caller's arena, until the context is
/// cancelled. What a call throws cancels the others and comes out here.
///
/// The threads draw their numbers from one counter; oneTBB orders what happens before, in and after the loop.
template <class Function>
void for_each_index(std::size_t count, tbb::task_group_context& context, const Function& function) {
    std::atomic<std::size_t> next = 0;
    const auto work = [&next, &function, &context, count](int) {
        const FloatEnvironment environment;  // a thread of the arena may have any
        for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) {
            if (context.is_group_execution_cancelled()) return;
            function(i);
        }
    };
    tbb::parallel_for(0, tbb::this_task_arena::max_concurrency(), work, tbb::simple_partitioner{}, context);
}

/// Calls function(0) ... function(height - 1), also where the render around it is cancelled.
template <class Function>
void for_each_row(int height, const Function& function) {
    tbb::task_group_context context(tbb::task_group_context::isolated);
    for_each_index(static_cast<std::size_t>(height), context, [&](std::size_t y) { function(static_cast<int>(y)); });
}

/// Calls function() with so many threads; 0: with those of the caller's arena.
template <class Function>
void with_threads(int threads, const Function& function) {
    const FloatEnvironment environment;
    query::with_threads(threads, function);
}

}  // namespace limn::transport
