#include "limn/render/render.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <chrono>

#include "core/float_environment.h"
#include "flat/scene.h"
#include "limn/core/error.h"
#include "render/film.h"
#include "render/parallel.h"
#include "render/path.h"
#include "render/sampler.h"

namespace limn {

namespace {

constexpr int kTile = 16;         // pixels a side: some thousand paths, enough work to hide the cost of a task
constexpr int kLargestPass = 64;  // samples a pixel between two chances to stop with an even picture
constexpr int kMaxSide = 1 << 20;
constexpr int kMaxThreads = 1024;

void check(const CompiledScene& scene, const RenderSettings& s) {
    const auto require = [](bool holds, const char* what) {
        if (!holds) throw ArgumentError(std::string("render: ") + what);
    };
    require(s.width > 0 && s.height > 0 && s.width <= kMaxSide && s.height <= kMaxSide,
            "width and height must lie in 1 to 1048576");
    require(s.samples_per_pixel > 0, "samples per pixel must be at least 1");
    require(s.max_depth > 0, "the depth limit must be at least 1");
    require(s.threads >= 0 && s.threads <= kMaxThreads, "threads must lie in 0 to 1024");
    if (scene.flat().unassigned > 0)
        throw Error("render: " + std::to_string(scene.flat().unassigned) + " shapes of the scene have no material");
}

// One picture being rendered: passes over all tiles, each of more samples than the one before, so that a render that is
// stopped leaves a whole picture.
class Job {
public:
    Job(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings)
        : scene_(scene.flat()),
          camera_(camera, settings.width, settings.height),
          settings_(settings),
          film_(settings.width, settings.height) {}

    void run() {
        report(true);
        int done = 0;
        int pass = tracing::kReplicates;
        for (; done < settings_.samples_per_pixel && !stop_; pass = std::min(2 * pass, kLargestPass)) {
            const int target = done + std::min(pass, settings_.samples_per_pixel - done);
            const int columns = (settings_.width + kTile - 1) / kTile, rows = (settings_.height + kTile - 1) / kTile;
            const auto tiles = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
            tracing::for_each_index(tiles, context_, [&](std::size_t tile) {
                if (stop_) return;
                const auto across = static_cast<std::size_t>(columns);
                render_tile(static_cast<int>(tile % across) * kTile, static_cast<int>(tile / across) * kTile, target);
                report(false);
            });
            if (context_.is_group_execution_cancelled()) stop_ = true;  // by us, or by the caller's own task group
            done = target;
        }
        if (!stop_) report(true);
    }

    RenderResult result(const CompiledScene& scene, int threads) const {
        RenderResult r{film_.image(), film_.error(), {}};
        r.report.scene = scene.name();
        r.report.width = settings_.width, r.report.height = settings_.height;
        r.report.seed = settings_.seed;
        r.report.threads = threads;
        r.report.max_depth = settings_.max_depth;
        r.report.samples_per_pixel = film_.mean_samples();
        r.report.compile_seconds = scene.stats().seconds;
        r.report.render_seconds = seconds();
        r.report.rays = rays_;
        r.report.nonfinite_samples = nonfinite_;
        r.report.unusable_rays = unusable_rays_;
        r.report.features = scene.features();
        r.report.memory_bytes = scene.stats().memory_bytes + film_.memory_bytes();
        r.report.complete = samples_done_ == all_samples();
        return r;
    }

private:
    void render_tile(int left, int top, int target) {
        tracing::PathTracer tracer(scene_, settings_.max_depth, settings_.estimator);
        std::uint64_t nonfinite = 0, samples = 0;
        const int right = std::min(left + kTile, settings_.width), bottom = std::min(top + kTile, settings_.height);
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x)
                for (auto i = film_.samples(x, y); i < static_cast<std::uint32_t>(target); ++i, ++samples)
                    nonfinite += film_.add(x, y, sample(x, y, i, tracer)) ? 0 : 1;
        rays_ += tracer.rays();
        unusable_rays_ += tracer.unusable_rays();
        nonfinite_ += nonfinite;
        samples_done_ += samples;
    }

    Color sample(int x, int y, std::uint64_t i, tracing::PathTracer& tracer) const {
        const auto pixel =
            static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(settings_.width) + static_cast<std::uint64_t>(x);
        tracing::Sampler sampler(settings_.seed, pixel, i);
        // Drawn whether needed or not, so that each dimension keeps its meaning.
        const Uv in_pixel = sampler.next_2d(), on_lens = sampler.next_2d();
        const double in_shutter = sampler.next();
        const double dx = settings_.antialias ? in_pixel.u : 0.5, dy = settings_.antialias ? in_pixel.v : 0.5;
        return tracer.radiance(camera_.ray(x + dx, y + dy, on_lens.u, on_lens.v, in_shutter), sampler);
    }

    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

    // Tells the caller how far things are; at most every 50 ms, unless `always`.
    void report(bool always) {
        if (!settings_.progress) return;
        if (stop_ || reporting_.test_and_set(std::memory_order_acquire)) return;
        struct Finish {
            std::atomic_flag& flag;
            ~Finish() { flag.clear(std::memory_order_release); }
        } const finish{reporting_};
        const double now = seconds();
        if (!always && now - last_report_ < 0.05) return;
        last_report_ = now;
        if (!settings_.progress({fraction(), now})) {
            stop_ = true;
            context_.cancel_group_execution();
        }
    }

    std::uint64_t all_samples() const {
        return static_cast<std::uint64_t>(settings_.width) * static_cast<std::uint64_t>(settings_.height) *
               static_cast<std::uint64_t>(settings_.samples_per_pixel);
    }
    double fraction() const { return static_cast<double>(samples_done_) / static_cast<double>(all_samples()); }

    const flat::Scene& scene_;
    const CameraRays camera_;
    const RenderSettings& settings_;
    tracing::Film film_;
    tbb::task_group_context context_;
    std::atomic<bool> stop_ = false;
    std::atomic<std::uint64_t> rays_ = 0, unusable_rays_ = 0, nonfinite_ = 0, samples_done_ = 0;
    std::atomic_flag reporting_;  // not a mutex: a callback that uses TBB may come back here on the same thread
    double last_report_ = 0;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

RenderResult render(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings) {
    const FloatEnvironment environment;
    check(scene, settings);
    Job job(scene, camera, settings);
    if (settings.threads == 0) {
        job.run();
        return job.result(scene, tbb::this_task_arena::max_concurrency());
    }
    // More threads than processors are allowed, for whoever asks for them.
    const auto threads = static_cast<std::size_t>(settings.threads);
    const tbb::global_control allow(
        tbb::global_control::max_allowed_parallelism,
        std::max(threads, tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)));
    tbb::task_arena arena(settings.threads);
    arena.execute([&] { job.run(); });
    return job.result(scene, settings.threads);
}

const char* version() { return LIMN_VERSION; }

}  // namespace limn
