#include "limn/render/render.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/float_environment.h"
#include "flat/scene.h"
#include "limn/core/error.h"
#include "render/error_estimate.h"
#include "render/film.h"
#include "render/parallel.h"
#include "render/path.h"
#include "render/sample_rates.h"
#include "render/sampler.h"

namespace limn {

namespace {

constexpr int kTile = 16;            // pixels a side: some thousand paths, enough work to hide the cost of a task
constexpr int kLargestPass = 64;     // samples a pixel between two chances to stop with an even picture
constexpr std::size_t kBatch = 512;  // paths traced together: their state fits the second cache
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
    require(!s.error || (*s.error > 0 && std::isfinite(*s.error)), "the error asked for must be over 0 and finite");
    require(!s.time_limit || (*s.time_limit > 0 && std::isfinite(*s.time_limit)),
            "the time limit must be over 0 and finite");
    require(s.max_samples_per_pixel > 0, "the most samples per pixel must be at least 1");
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
          most_samples_(settings.error || settings.time_limit ? settings.max_samples_per_pixel
                                                              : settings.samples_per_pixel),
          adaptive_((settings.error || settings.time_limit) && !settings.uniform),
          has_lens_or_motion_(camera.aperture_angle > 0 || scene_.features.moving_spheres ||
                              scene_.features.moving_instances || scene_.features.foreign_shapes),
          film_(settings.width, settings.height) {}

    void run() {
        report(true);
        // Without a target there is never a check.
        int done = 0, check = settings_.error ? tracing::kFirstPass : most_samples_;
        for (int pass = tracing::kFirstPass; done < most_samples_ && !ended();
             pass = std::min(2 * pass, kLargestPass)) {
            done = std::min({done + pass, check, most_samples_});
            if (adaptive_ && rates_.empty() && done > tracing::kFirstPass) rates_ = tracing::sample_rates(film_);
            if (!rates_.empty()) plan_ = tracing::plan_samples(film_, rates_, done);
            render_pass(done);
            if (done == check && settings_.error && !ended()) check = check_error(done);
        }
        finished_ = true;
        if (!interrupted_) report(true);
    }

    RenderResult result(const CompiledScene& scene, int threads) const {
        RenderResult r{film_.image(), {}, {}, {}};
        r.error = tracing::estimate_error(film_, &r.maps);
        r.error.target = settings_.error;
        r.error.reached = settings_.error && r.error.ci95_high <= *settings_.error;
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
        r.report.memory_bytes = scene.stats().memory_bytes + film_.memory_bytes() + rates_.size() * sizeof(float) +
                                plan_.size() * sizeof(std::uint32_t);
        r.report.complete = !interrupted_;
        r.report.stopped_by = interrupted_ ? StoppedBy::callback
                              : reached_   ? StoppedBy::error
                              : timed_out_ ? StoppedBy::time
                                           : StoppedBy::samples;
        return r;
    }

private:
    bool ended() const { return interrupted_ || reached_ || timed_out_; }

    void render_pass(int target) {
        const int columns = (settings_.width + kTile - 1) / kTile, rows = (settings_.height + kTile - 1) / kTile;
        const auto tiles = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
        tracing::for_each_index(tiles, context_, [&](std::size_t tile) {
            if (interrupted_) return;
            // The first pass is for all pixels, whatever it takes, so that there is a picture and an estimate.
            if (settings_.time_limit && target > tracing::kFirstPass && seconds() >= *settings_.time_limit)
                timed_out_ = true;
            if (timed_out_) return;
            const auto across = static_cast<std::size_t>(columns);
            render_tile(static_cast<int>(tile % across) * kTile, static_cast<int>(tile / across) * kTile, target);
            report(false);
        });
        if (context_.is_group_execution_cancelled()) interrupted_ = true;  // by us, or by the caller's own task group
    }

    // Whether the error is little enough after `done` samples a pixel; returns when to ask again.
    int check_error(int done) {
        const ErrorEstimate e = tracing::check_error(film_);
        const double upper = e.reason.empty() ? e.ci95_high : std::numeric_limits<double>::infinity();
        reached_ = upper <= *settings_.error;
        // Where independent samples would reach it: where this stands in between tells how far the render has come.
        samples_needed_ = done * std::max(1.0, upper / *settings_.error);
        return tracing::next_check(done, upper, *settings_.error);
    }

    std::uint32_t wanted(int x, int y, int target) const {
        return plan_.empty() ? static_cast<std::uint32_t>(target) : plan_[film_.index(x, y)];
    }

    void render_tile(int left, int top, int target) {
        tracing::PathTracer tracer(scene_, settings_.max_depth, settings_.estimator);
        std::uint64_t nonfinite = 0, samples = 0;
        const int right = std::min(left + kTile, settings_.width), bottom = std::min(top + kTile, settings_.height);
        std::vector<tracing::Path> paths;
        std::vector<std::pair<int, int>> pixels;
        const auto flush = [&] {
            set_camera_rays(paths, pixels);
            tracer.trace(paths);
            for (std::size_t i = 0; i < paths.size(); ++i)
                nonfinite += film_.add(pixels[i].first, pixels[i].second, paths[i].radiance) ? 0 : 1;
            samples += paths.size();
            paths.clear(), pixels.clear();
        };
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x)
                for (auto i = film_.samples(x, y), n = wanted(x, y, target); i < n; ++i) {
                    paths.push_back({tracing::Sampler(settings_.seed, film_.index(x, y), i, settings_.sampler)});
                    pixels.emplace_back(x, y);
                    if (paths.size() == kBatch) flush();
                }
        flush();
        rays_ += tracer.rays();
        unusable_rays_ += tracer.unusable_rays();
        nonfinite_ += nonfinite;
        samples_done_ += samples;
    }

    void set_camera_rays(std::span<tracing::Path> paths, const std::vector<std::pair<int, int>>& pixels) const {
        // In the pixel, on the lens, in time.
        kernels::SobolLanes lanes;
        kernels::Lane numbers[5] = {};
        for (std::size_t first = 0; first < paths.size(); first += kernels::kShaded) {
            const std::span some = paths.subspan(first, std::min(kernels::kShaded, paths.size() - first));
            const auto sampler_at = [&](std::size_t i) -> tracing::Sampler& { return some[i].sampler; };
            if (has_lens_or_motion_)
                tracing::Sampler::draw_many<5>(some.size(), sampler_at, lanes, numbers);
            else
                tracing::Sampler::draw_many<2>(some.size(), sampler_at, lanes, numbers);
            for (std::size_t i = 0; i < some.size(); ++i) {
                const auto [x, y] = pixels[first + i];
                const double dx = settings_.antialias ? numbers[0][i] : 0.5;
                const double dy = settings_.antialias ? numbers[1][i] : 0.5;
                some[i].ray = camera_.ray(x + dx, y + dy, numbers[2][i], numbers[3][i], numbers[4][i]);
            }
        }
    }

    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

    // Tells the caller how far things are; at most every 50 ms, unless `always`.
    void report(bool always) {
        if (!settings_.progress) return;
        if (interrupted_ || reporting_.test_and_set(std::memory_order_acquire)) return;
        struct Finish {
            std::atomic_flag& flag;
            ~Finish() { flag.clear(std::memory_order_release); }
        } const finish{reporting_};
        const double now = seconds();
        if (!always && now - last_report_ < 0.05) return;
        last_report_ = now;
        last_fraction_ = std::max(last_fraction_, fraction(now));
        if (!settings_.progress({last_fraction_, now}) && !finished_) {
            interrupted_ = true;
            context_.cancel_group_execution();
        }
    }

    // Of what will end the render first, as far as that can be known.
    double fraction(double now) const {
        const double samples =
            static_cast<double>(samples_done_) / (static_cast<double>(settings_.width) * settings_.height);
        double fraction = samples / most_samples_;
        if (settings_.time_limit) fraction = std::max(fraction, now / *settings_.time_limit);
        if (settings_.error) fraction = std::max(fraction, samples / samples_needed_);
        return finished_ ? 1 : samples_done_ == 0 ? 0 : std::min(fraction, 1.0);
    }

    const flat::Scene& scene_;
    const CameraRays camera_;
    const RenderSettings& settings_;
    const int most_samples_;  // a pixel, in the mean
    const bool adaptive_, has_lens_or_motion_;
    tracing::Film film_;
    // From the pilot on, where samples are adaptive.
    std::vector<float> rates_;
    std::vector<std::uint32_t> plan_;
    tbb::task_group_context context_;
    std::atomic<bool> interrupted_ = false, timed_out_ = false;
    bool reached_ = false, finished_ = false;
    double samples_needed_ = 128 * tracing::kFirstPass;  // a guess before the first check
    std::atomic<std::uint64_t> rays_ = 0, unusable_rays_ = 0, nonfinite_ = 0, samples_done_ = 0;
    std::atomic_flag reporting_;  // not a mutex: a callback that uses TBB may come back here on the same thread
    double last_report_ = 0, last_fraction_ = 0;
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
    return arena.execute([&] {
        job.run();
        return job.result(scene, settings.threads);
    });
}

const char* version() { return LIMN_VERSION; }

}  // namespace limn
