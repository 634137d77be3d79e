// Runs the batches of queries on several threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "geometry/bvh/parallel.h"
#include "limn/math/error.h"

namespace limn::query {

using accel::with_threads;

inline constexpr int kMostThreads = 1024;  // a larger number is taken for a mistake

// The number of queries that are worth a task of their own.
inline constexpr std::size_t kPart = 1024;

// Calls work(first, count) for consecutive parts of a batch of `size` queries, on `threads` threads; 0 stands for those
// of the caller's TBB arena. No part is empty. With one thread, the whole batch is one part; otherwise a part has at
// most kPart queries.
// \throws ArgumentError if `threads` is not 0 to kMostThreads; the message begins with `who`
template <class Work>
void for_all_parts(std::size_t size, int threads, const char* who, const Work& work) {
    if (threads < 0 || threads > kMostThreads)
        throw ArgumentError(std::string(who) + ": threads must lie in 0 to " + std::to_string(kMostThreads));
    if (size == 0) return;
    if (threads == 1 || size <= kPart) return work(std::size_t{0}, size);
    with_threads(threads, [&] {
        accel::for_all(0, (size + kPart - 1) / kPart, 1,
                       [&](std::size_t i) { work(i * kPart, std::min(kPart, size - i * kPart)); });
    });
}

// Throws an ArgumentError with `message` if the two lengths differ.
inline void check_length(std::size_t queries, std::size_t results, const char* message) {
    if (queries != results) throw ArgumentError(message);
}

}  // namespace limn::query
