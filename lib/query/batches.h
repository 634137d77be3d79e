// Runs batches of queries on several threads. Like ask(), the functions below set the floating-point environment.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <span>
#include <string>

#include "limn/math/error.h"
#include "math/parallel.h"
#include "query/ask.h"

namespace limn::query {

inline constexpr int kMostThreads = 1024;  // a larger number is taken for a mistake

// The number of queries that are worth a task of their own.
inline constexpr std::size_t kPart = 1024;

// Returns the number of queries in each part of a batch but the last: see for_all_parts().
inline std::size_t part_size(std::size_t size, int threads) {
    return threads == 1 ? std::max<std::size_t>(size, 1) : kPart;
}

// Calls work(first, count) for consecutive parts of a batch of `size` queries, on `threads` threads; 0 stands for those
// of the caller's TBB arena. No part is empty. With one thread, the whole batch is one part; otherwise a part has at
// most kPart queries.
// \throws ArgumentError if `threads` is not 0 to kMostThreads; the message begins with `who`
template <class Work>
void for_all_parts(std::size_t size, int threads, const char* who, const Work& work) {
    if (threads < 0 || threads > kMostThreads)
        throw ArgumentError(std::string(who) + ": threads must be in 0 to " + std::to_string(kMostThreads));
    const std::size_t part = part_size(size, threads), parts = (size + part - 1) / part;
    const auto run = [&] {
        for_all(0, parts, 1, [&](std::size_t i) { work(i * part, std::min(part, size - i * part)); });
    };
    if (parts <= 1)
        run();
    else
        with_threads(threads, run);
}

// Throws an ArgumentError if the lengths of a batch and of its results differ. \param names "rays and hits"
inline void check_length(std::size_t queries, std::size_t results, const char* who, const char* names) {
    if (queries != results) throw ArgumentError(std::string(who) + ": " + names + " differ in length");
}

// Sets results[i] to answer(i, filter) for each usable ray i of a batch, and to a default-constructed result for each
// unusable one. `filter` is that of the ray in the form of checked(). Returns the number of unusable rays.
// \throws ArgumentError as checked() and for_all_parts() do, and if `filter.without_each` does not fit the batch
template <class Result, class Answer>
std::size_t answer_rays(const flat::Scene& scene, std::span<const Ray> rays, std::span<Result> results, int threads,
                        const RayFilter& filter, const char* who, const Answer& answer) {
    // Check the filter.
    const std::span<const std::uint64_t> each = filter.without_each;
    if (!each.empty() && each.size() != rays.size())
        throw ArgumentError(std::string(who) + ": filter.without_each must be empty or as long as there are rays");
    const Excluded of_all = checked(scene, filter, who);
    // Answer the queries.
    std::atomic<std::size_t> unusable = 0;
    for_all_parts(rays.size(), threads, who, [&](std::size_t first, std::size_t count) {
        Excluded of_ray = of_all;
        for (std::size_t i = first; i < first + count; ++i) {
            if (!each.empty()) of_ray->without = each[i];
            const bool is_usable = is_fit(rays[i]);
            results[i] = is_usable ? static_cast<Result>(answer(i, of_ray)) : Result{};
            if (!is_usable) ++unusable;
        }
    });
    return unusable;
}

}  // namespace limn::query
