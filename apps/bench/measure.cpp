#include "bench/session.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace limn::bench {

namespace {

constexpr double kSameT = 1e-3;  // relative: a larger difference is another surface

// A measurement lasts at least this long, so that starting threads and reading clocks do not count.
constexpr double kLeastSeconds = 0.004;

double quantile(const std::vector<double>& sorted, double q) {
    const double place = q * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

void trace_all(Subject& subject, std::size_t rays, tbb::task_arena& arena) {
    // Every thread gets several parts.
    const std::size_t share = rays / (8 * static_cast<std::size_t>(arena.max_concurrency())) / 64 * 64;
    const std::size_t size = std::clamp<std::size_t>(share, 64, 65536);
    arena.execute([&] {
        tbb::parallel_for(std::size_t{0}, (rays + size - 1) / size,
                          [&](std::size_t i) { subject.trace(i * size, std::min(size, rays - i * size)); });
    });
}

// Returns the time of one pass over the rays.
double time_of(Subject& subject, std::size_t rays, tbb::task_arena& arena) {
    const Stopwatch watch(arena.max_concurrency() == 1 ? Clock::thread : Clock::wall);
    for (int passes = 1;; ++passes) {
        trace_all(subject, rays, arena);
        if (const double seconds = watch.seconds(); seconds >= kLeastSeconds) return seconds / passes;
    }
}

bool agrees(const Answer& a, const Answer& b) {
    if ((a.t == kInfinity) != (b.t == kInfinity)) return false;
    return a.t == b.t || std::abs(a.t - b.t) <= kSameT * std::abs(a.t);
}

}  // namespace

Spread spread_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    return {.median = quantile(values, 0.5), .low = quantile(values, 0.25), .high = quantile(values, 0.75)};
}

Spread ratio(const Timing& a, const Timing& b) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(a.seconds.size(), b.seconds.size()); ++i)
        ratios.push_back(b.seconds[i] / a.seconds[i]);
    return spread_of(std::move(ratios));
}

std::vector<Timing> measure(std::span<const std::unique_ptr<Subject>> subjects, const RaySet& set, int threads,
                            int rounds, const std::function<bool()>& keep_going) {
    tbb::task_arena arena(threads);
    const std::size_t rays = set.rays.size();
    std::vector<Timing> timings;
    for (const auto& subject : subjects) {
        subject->prepare(set);
        trace_all(*subject, rays, arena);
        Timing& timing = timings.emplace_back(Timing{.subject = subject->name});
        for (std::size_t i = 0; i < rays; ++i) {
            const Answer expected = subjects.front()->answer(i), found = subject->answer(i);
            timing.mismatches += agrees(expected, found) ? 0 : 1;
            timing.differences += expected == found ? 0 : 1;
        }
        if (!keep_going()) return timings;
    }
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t s = 0; s < subjects.size(); ++s) {
            timings[s].seconds.push_back(time_of(*subjects[s], rays, arena));
            if (!keep_going()) return timings;
        }
    }
    return timings;
}

}  // namespace limn::bench
