#include "bench/session.h"

#include <fmt/format.h>
#include <hwy/targets.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "limn/math/error.h"
#include "limn/render/render.h"
#include "module.h"

namespace limn::bench {
namespace {

using app::Json;

// limn's public queries, of single rays or of batches.
class LimnSubject final : public Subject {
public:
    // `batch` is the number of rays of a query, 0 for single rays. `targets` are bits of Highway's instruction sets.
    LimnSubject(const std::string& subject_name, std::shared_ptr<const CompiledScene> scene, std::size_t batch,
                std::int64_t targets)
        : Subject(subject_name), scene_(std::move(scene)), batch_(batch), targets_(targets) {}

    void prepare(const RaySet& set) override {
        set_ = &set;
        hits_.assign(set.any ? 0 : set.rays.size(), {});
        occluded_.assign(set.any ? set.rays.size() : 0, 0);
    }

    void trace(std::size_t first, std::size_t count) override {
        hwy::GetChosenTarget().Update(targets_);
        const std::vector<Ray>& rays = set_->rays;
        const std::size_t end = first + count;
        if (batch_ != 0)
            for (std::size_t i = first; i < end; i += batch_) trace_batch(i, std::min(batch_, end - i));
        else if (set_->any)
            for (std::size_t i = first; i < end; ++i) occluded_[i] = scene_->any_hit(rays[i]) ? 1 : 0;
        else
            for (std::size_t i = first; i < end; ++i) hits_[i] = scene_->closest_hit(rays[i]).value_or(RayHit{});
    }

    RayHit answer(std::size_t i) const override {
        return set_->any ? RayHit{.t = occluded_[i] != 0 ? 0 : kInfinity} : hits_[i];
    }

private:
    void trace_batch(std::size_t first, std::size_t count) {
        const std::span<const Ray> rays = std::span(set_->rays).subspan(first, count);
        set_->any ? scene_->any_hit(rays, std::span(occluded_).subspan(first, count))
                  : scene_->closest_hit(rays, std::span(hits_).subspan(first, count));
    }

    const std::shared_ptr<const CompiledScene> scene_;
    const std::size_t batch_;
    const std::int64_t targets_;
    const RaySet* set_ = nullptr;
    std::vector<RayHit> hits_;
    std::vector<std::uint8_t> occluded_;
};

constexpr double kSameT = 1e-3;  // largest relative difference of t of the same surface

// The least time of a measurement. It is long enough that starting threads and reading clocks hardly count.
constexpr double kLeastSeconds = 0.004;

void trace_all(Subject& subject, std::size_t rays, tbb::task_arena& arena) {
    // Divide the rays so that each thread gets several parts. A part has a multiple of 64 rays.
    const std::size_t share = rays / (8 * static_cast<std::size_t>(arena.max_concurrency())) / 64 * 64;
    const std::size_t size = std::clamp<std::size_t>(share, 64, 65536);
    arena.execute([&] {
        tbb::parallel_for(std::size_t{0}, (rays + size - 1) / size,
                          [&](std::size_t i) { subject.trace(i * size, std::min(size, rays - i * size)); });
    });
}

// Returns the seconds in which the rays are traced once.
double time_of(Subject& subject, std::size_t rays, tbb::task_arena& arena) {
    const Clock clock = arena.max_concurrency() == 1 ? Clock::thread : Clock::wall;
    const double begin = seconds(clock);
    for (int passes = 1;; ++passes) {
        trace_all(subject, rays, arena);
        if (const double spent = seconds(clock) - begin; spent >= kLeastSeconds) return spent / passes;
    }
}

// A few rounds of building a small scene are too short. They are repeated for this many seconds, at most this often.
constexpr double kLeastBuilding = 0.05;
constexpr int kMostBuilds = 200;

constexpr char kLine[] = "  {:<10} {:>2} {:>7} {:>7} {:>7} {:>7} {:>7} {:>9}  {:<18} {:<18} {:<18} {:>8}\n";

// Returns the timing of the fastest subject for whose name `fits` returns true, or null.
const Timing* fastest(const std::vector<Timing>& timings, const auto& fits) {
    const auto median = [&](const Timing& t) {
        return fits(t.subject) && !t.seconds.empty() ? spread_of(t.seconds).median : kInfinity;
    };
    const auto best = std::ranges::min_element(timings, {}, median);
    return best != timings.end() && median(*best) < kInfinity ? &*best : nullptr;
}

// Returns how many times faster a is than b, with quartiles, as text.
std::string ratio_text(const Timing* a, const Timing* b) {
    if (a == nullptr || b == nullptr) return "-";
    const Spread r = ratio(*a, *b);
    return fmt::format("{:.2f} ({:.2f}..{:.2f})", r.median, r.low, r.high);
}

double million_a_second(const Timing& timing, double rays) { return 1e-6 * rays / spread_of(timing.seconds).median; }

std::string row_text(const RaySet& set, int threads, const std::vector<Timing>& timings) {
    const auto find = [&](const char* name) { return fastest(timings, [&](const auto& s) { return s == name; }); };
    const Timing *single = find("limn"), *plain = find("Embree"), *robust = find("Embree robust");
    const Timing* batch = fastest(timings, [](const std::string& s) { return s.starts_with("limn batch"); });
    const Timing* best =
        fastest(timings, [](const std::string& s) { return s.starts_with("Embree") && s != "Embree robust"; });
    const auto rays = static_cast<double>(set.rays.size());
    const auto rate = [&](const Timing* t) { return t ? fmt::format("{:.2f}", million_a_second(*t, rays)) : "-"; };
    const auto differ = [&](const Timing* t) {
        return t ? fmt::format("{:.1f}", 1e6 * static_cast<double>(t->mismatches) / rays) : "-";
    };
    return fmt::format(kLine, set.name, threads, rate(single), rate(batch), rate(plain), rate(robust), rate(best),
                       best == nullptr || best == plain ? "1" : best->subject.substr(7), ratio_text(single, plain),
                       ratio_text(single, robust), ratio_text(batch, best), differ(plain) + "/" + differ(robust));
}

struct Session {
    const Plan& plan;
    const std::vector<Contender>& contenders;
    const Watch& watch;
    Results results{};
    Json scenes = Json::array();
    double scenes_done = 0;
    double part = 0;    // part of the current scene's measurements that is done, 0 to 1
    bool going = true;  // false if `watch` has returned false

    Results run() {
        for (const std::string& name : plan.scenes)
            if (goes_on()) scenes.push_back(measure_scene(make_scene(name, plan.scale)));
        for (const std::string& path : plan.models)
            if (goes_on()) scenes.push_back(measure_scene(load_scene(path)));
        Json versions = Json::object();
        for (const Contender& contender : contenders) versions[contender.name] = contender.version;
        results.json = {{"complete", going}, {"versions", versions}, {"rounds", plan.rounds}, {"scenes", scenes}};
        return std::move(results);
    }

    // Reports the progress. Returns false if the run must end.
    bool goes_on() {
        const auto count = static_cast<double>(plan.scenes.size() + plan.models.size());
        going = going && watch((scenes_done + part) / count);
        return going;
    }

    // Adds a scene to the table and returns its results as JSON.
    Json measure_scene(const Geometry& geometry) {
        const std::size_t count = stored_primitives(geometry);
        Json bytes = Json::object(), builds = Json::array(), rows = Json::array();
        results.table += fmt::format("{}: {} primitives", geometry.name, count);
        std::vector<std::unique_ptr<Subject>> subjects;
        for (const Contender& contender : contenders) {
            BuiltScene built = contender.build(geometry, Clock::wall);
            bytes[contender.name] = built.bytes;
            results.table += fmt::format("; {} {:.1f} bytes each", contender.name,
                                         static_cast<double>(built.bytes) / static_cast<double>(count));
            std::ranges::move(built.subjects, std::back_inserter(subjects));
        }
        results.table += '\n';
        for (const int threads : plan.threads) builds.push_back(measure_builds(geometry, threads));
        if (goes_on()) rows = measure_rays(geometry, subjects);
        ++scenes_done;
        part = 0;
        return {{"name", geometry.name}, {"primitives", count}, {"bytes", bytes}, {"builds", builds}, {"rows", rows}};
    }

    Json measure_builds(const Geometry& geometry, int threads) {
        std::vector<Timing> timings;
        for (const Contender& contender : contenders) timings.push_back({.subject = contender.name});
        // Limit the threads, also those of Embree.
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(threads));
        // Build in rounds.
        const Clock clock = threads == 1 ? Clock::process : Clock::wall;
        const int most = plan.build_rounds == 0 ? 0 : std::max(plan.build_rounds, kMostBuilds);
        double spent = 0;
        for (int round = 0; going && round < most && (round < plan.build_rounds || spent < kLeastBuilding); ++round) {
            for (std::size_t i = 0; i < contenders.size() && goes_on(); ++i) {
                timings[i].seconds.push_back(contenders[i].build(geometry, clock).seconds);
                spent += timings[i].seconds.back();
            }
        }
        // Store the times.
        Json seconds = Json::object();
        std::string text;
        for (const Timing& t : timings) {
            seconds[t.subject] = t.seconds;
            if (t.seconds.empty()) continue;
            text += fmt::format("{} {} {:.3f} s", text.empty() ? "" : ",", t.subject, spread_of(t.seconds).median);
            if (&t != &timings.front()) text += " x " + ratio_text(&timings.front(), &t);
        }
        if (!text.empty())
            results.table += fmt::format("  built by {} thread{}:{}\n", threads, threads == 1 ? "" : "s", text);
        return {{"threads", threads}, {"seconds", seconds}};
    }

    Json measure_rays(const Geometry& geometry, const std::vector<std::unique_ptr<Subject>>& subjects) {
        std::vector<RaySet> sets = make_rays(geometry, compile(describe(geometry)), plan.rays);
        if (!plan.kinds.empty())
            std::erase_if(sets, [&](const RaySet& set) { return std::ranges::count(plan.kinds, set.name) == 0; });
        const auto measurements = static_cast<double>(sets.size() * plan.threads.size());
        results.table += fmt::format(kLine, "rays", "th", "limn", "batch", "Embree", "robust", "best", "(mode)",
                                     "limn/Embree", "limn/robust", "batch/best", "differ/M");
        Json rows = Json::array();
        for (const RaySet& set : sets) {
            for (const int threads : plan.threads) {
                if (!goes_on()) return rows;
                rows.push_back(
                    row(set, threads, measure(subjects, set, threads, plan.rounds, [&] { return goes_on(); })));
                part += 1 / measurements;
            }
        }
        return rows;
    }

    // Adds a row to the table and returns it as JSON. Sets `results.fault` if batches and single rays differ.
    Json row(const RaySet& set, int threads, const std::vector<Timing>& timings) {
        Json subjects = Json::array();
        std::size_t differences = 0;  // rays for which a subject of limn differs from single rays
        for (const Timing& t : timings) {
            if (!t.subject.starts_with("Embree")) differences += t.differences;
            if (t.seconds.empty()) continue;
            subjects.push_back({{"name", t.subject},
                                {"million_a_second", million_a_second(t, static_cast<double>(set.rays.size()))},
                                {"mismatches", t.mismatches},
                                {"seconds", t.seconds}});
        }
        if (differences > 0)
            results.fault = fmt::format("{}: {} rays have other results in batches", set.name, differences);
        results.table += row_text(set, threads, timings);
        return {{"rays", set.name},   {"count", set.rays.size()},   {"any", set.any},
                {"threads", threads}, {"differences", differences}, {"subjects", subjects}};
    }
};

}  // namespace

BuiltScene build_limn(const Geometry& geometry, Clock clock) {
    const Scene description = describe(geometry);  // not timed
    const double begin = seconds(clock);
    const auto scene = std::make_shared<const CompiledScene>(compile(description));
    BuiltScene built{.seconds = seconds(clock) - begin, .bytes = scene->stats().memory_bytes, .subjects = {}};
    const auto add = [&](const std::string& name, std::size_t batch, std::int64_t targets) {
        built.subjects.push_back(std::make_unique<LimnSubject>(name, scene, batch, targets));
    };
    const std::int64_t all = hwy::SupportedTargets(), better_than_avx2 = all & (HWY_AVX2 - 1);
    add("limn", 0, all);
    if (better_than_avx2 != 0) {
        add("AVX2", 0, all & ~better_than_avx2);
        add("AVX2 batch", 4096, all & ~better_than_avx2);
    }
    add("limn batch", 4096, all);
    for (const std::size_t size : {1, 8, 64, 65536}) add("limn batch " + std::to_string(size), size, all);
    return built;
}

std::vector<Contender> load_contenders(std::vector<std::string>& notes) {
    std::vector<Contender> contenders{{.name = "limn", .version = version(), .build = build_limn}};
    try {
        const auto add = reinterpret_cast<void (*)(std::vector<Contender>&)>(app::load_module("limn_bench_embree"));
        add(contenders);
    } catch (const Error& e) {
        notes.push_back(std::string("without Embree: ") + e.what());
    }
    return contenders;
}

Spread spread_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    const auto quantile = [&](double q) {
        const double place = q * static_cast<double>(values.size() - 1);
        const auto below = static_cast<std::size_t>(place);
        const std::size_t above = std::min(below + 1, values.size() - 1);
        return std::lerp(values[below], values[above], place - static_cast<double>(below));
    };
    return {.median = quantile(0.5), .low = quantile(0.25), .high = quantile(0.75)};
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
    const auto bits = [](const RayHit& hit) { return std::tuple(hit.t, hit.u, hit.v, hit.primitive); };
    std::vector<Timing> timings;
    // Trace with each subject, and compare its results with those of the first.
    for (const auto& subject : subjects) {
        subject->prepare(set);
        trace_all(*subject, rays, arena);
        Timing& timing = timings.emplace_back(Timing{.subject = subject->name});
        for (std::size_t i = 0; i < rays; ++i) {
            const RayHit expected = subjects.front()->answer(i), found = subject->answer(i);
            const bool agrees = expected.t == found.t || std::abs(expected.t - found.t) <= kSameT * expected.t;
            timing.mismatches += agrees ? 0 : 1;
            timing.differences += bits(expected) == bits(found) ? 0 : 1;
        }
        if (!keep_going()) return timings;
    }
    // Take the times.
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t s = 0; s < subjects.size(); ++s) {
            timings[s].seconds.push_back(time_of(*subjects[s], rays, arena));
            if (!keep_going()) return timings;
        }
    }
    return timings;
}

Results run_session(const Plan& plan, const std::vector<Contender>& contenders, const Watch& watch) {
    return Session{plan, contenders, watch}.run();
}

}  // namespace limn::bench
