#include "bench/measure.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "bench/stopwatch.h"

namespace limn::bench {

namespace {

constexpr double kSameT = 1e-3;  // relative: only what is another surface counts

double quantile(const std::vector<double>& sorted, double q) {
    const double place = q * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

// A measurement lasts at least this long, so that starting threads and reading clocks do not count.
constexpr double kLeastSeconds = 0.004;

// As many as the subject likes, but so few that every thread of several gets some. All packets fit in 64.
std::size_t chunk_for(const Subject& subject, std::size_t rays, const tbb::task_arena* arena) {
    if (arena == nullptr) return subject.chunk();
    const std::size_t share = rays / (8 * static_cast<std::size_t>(arena->max_concurrency())) / 64 * 64;
    return std::clamp<std::size_t>(share, 64, subject.chunk());
}

void trace_all(Subject& subject, std::size_t rays, tbb::task_arena* arena) {
    const std::size_t chunk = chunk_for(subject, rays, arena);
    const std::size_t chunks = (rays + chunk - 1) / chunk;
    const auto part = [&](std::size_t i) { subject.trace(i * chunk, std::min(chunk, rays - i * chunk)); };
    if (arena == nullptr)
        for (std::size_t i = 0; i < chunks; ++i) part(i);
    else
        arena->execute([&] { tbb::parallel_for(std::size_t{0}, chunks, part); });
}

// Of one pass over the rays.
double time_of(Subject& subject, std::size_t rays, tbb::task_arena* arena) {
    const Stopwatch watch(arena == nullptr ? Clock::thread : Clock::wall);
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
                            int rounds, const KeepGoing& keep_going) {
    std::unique_ptr<tbb::task_arena> arena;
    if (threads > 1) arena = std::make_unique<tbb::task_arena>(threads);
    const std::size_t rays = set.rays.size();
    std::vector<Timing> timings;
    for (const auto& subject : subjects) {
        subject->prepare(set);
        trace_all(*subject, rays, arena.get());
        timings.push_back({.subject = subject->name(), .seconds = {}, .mismatches = 0});
        for (std::size_t i = 0; i < rays; ++i)
            if (!agrees(subjects.front()->answer(i), subject->answer(i))) ++timings.back().mismatches;
        if (!keep_going()) return timings;
    }
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t s = 0; s < subjects.size(); ++s) {
            timings[s].seconds.push_back(time_of(*subjects[s], rays, arena.get()));
            if (!keep_going()) return timings;
        }
    }
    return timings;
}

std::size_t differences(const Subject& a, const Subject& b, std::size_t rays) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < rays; ++i)
        if (!(a.answer(i) == b.answer(i))) ++count;
    return count;
}

}  // namespace limn::bench
