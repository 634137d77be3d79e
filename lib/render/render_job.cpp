#include "limn/render/render_job.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <limits>
#include <mutex>

#include "limn/math/error.h"
#include "math/parallel.h"
#include "render/error_estimate.h"
#include "render/film_file.h"
#include "render/job_info.h"
#include "render/sample_rates.h"
#include "render/tile_renderer.h"

namespace limn {

namespace {

constexpr int kLargestPass = 64;  // the largest number of samples per pixel in a pass
using Clock = std::chrono::steady_clock;

}  // namespace

// Renders in passes over all tiles. A pass adds at most as many samples as there are already, and at most kLargestPass,
// so that all pixels of a stopped render have similar numbers of samples. The result of a pass depends on the film
// alone, not on how often the render was interrupted.
class RenderJob::Impl {
public:
    Impl(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings)
        : scene_(scene),
          settings_(settings),
          film_(transport::film_info(scene, camera, settings)),
          renderer_(scene.flat(), film_.info()) {}

    bool load(const std::string& path) {
        transport::FilmReader reader = checked_reader(path, transport::FilmContent::film);
        Film film(film_.info());
        reader.read_tiles(film);
        take_plan(reader, film);
        film.set_seconds(reader.seconds());
        film_ = std::move(film);
        is_planned_ = false;
        return film_.tiles().size() == reader.tiles().size();
    }

    void load_plan(const std::string& path) {
        // Replace the film's plan.
        transport::FilmReader reader = checked_reader(path, transport::FilmContent::plan);
        const SamplePlan before = film_.plan();
        take_plan(reader, film_);
        // Restore the old plan if the new one does not continue it.
        const SamplePlan& plan = film_.plan();
        const bool is_older = plan.samples < before.samples;
        if (is_older || (!before.rates.empty() && before.rates != plan.rates)) {
            film_.plan() = before;
            reader.fail(is_older ? "is older than the film" : "gives pixels other rates than the film");
        }
        is_planned_ = true;
    }

    StoppedBy run() {
        const bool ends_early = settings_.error || settings_.time_limit;
        const int most = is_planned_  ? film_.plan().samples
                         : ends_early ? settings_.max_samples_per_pixel
                                      : settings_.samples_per_pixel;
        return run_to(most, is_planned_ ? std::nullopt : settings_.error);
    }

    StoppedBy add_samples(int count) {
        if (count < 1) throw ArgumentError("RenderJob::add_samples: must be at least 1");
        if (count > std::numeric_limits<int>::max() - film_.plan().samples)
            throw ArgumentError("RenderJob::add_samples: are too many");
        return run_to(film_.plan().samples + count, std::nullopt);
    }

    void save(const std::string& path) const {
        // Write the tiles. Each is locked only while it is copied.
        transport::FilmWriter writer(path, film_);
        for (const std::uint32_t tile : film_.tiles()) {
            std::unique_lock lock(tile_mutex(tile));
            const std::vector<std::byte> bytes = film_.tile_bytes(tile);
            lock.unlock();
            writer.tile(bytes);
        }
        // Copy the plan, but refer to its rates: they do not change once they are set.
        SamplePlan plan;
        std::span<const float> rates;
        double seconds = 0;
        {
            const std::scoped_lock lock(plan_mutex_);
            const SamplePlan& now = film_.plan();
            plan.samples = now.samples;
            plan.scale = now.scale;
            plan.upper_error = now.upper_error;
            rates = now.rates;
            seconds = film_.seconds() + (is_running_ ? seconds_of_run() : 0);
        }
        writer.finish(plan, rates, seconds);
    }

    Image image() const {
        Image image(film_.width(), film_.height());
        for (const std::uint32_t number : film_.tiles()) {
            const std::scoped_lock lock(tile_mutex(number));
            film_.draw(number, image);
        }
        return image;
    }

    std::vector<float> alpha() const {
        std::vector<float> alpha(film_.info().transparent ? film_.pixels() : 0);
        if (alpha.empty()) return alpha;
        for (const std::uint32_t number : film_.tiles()) {
            const std::scoped_lock lock(tile_mutex(number));
            film_.draw_alpha(number, alpha);
        }
        return alpha;
    }

    const Film& film() const { return film_; }

    RenderResult result() const {
        RenderResult r = with_threads(settings_.threads, [&] { return render_result(film_, settings_.error); });
        r.report.threads = settings_.threads > 0 ? settings_.threads : tbb::this_task_arena::max_concurrency();
        r.report.compile_seconds = scene_.stats().seconds;
        r.report.memory_bytes += scene_.stats().memory_bytes;
        r.report.complete = !interrupted_;
        r.report.stopped_by = stopped_by();
        return r;
    }

private:
    // Opens a file. \throws FileError if it is of another render or lacks tiles of this one
    transport::FilmReader checked_reader(const std::string& path, transport::FilmContent content) const {
        transport::FilmReader reader(path, content);
        if (const std::string other = difference(reader.info(), film_.info()); !other.empty())
            reader.fail("is not of this render: " + other);
        if (!std::ranges::includes(reader.tiles(), film_.tiles())) reader.fail("lacks tiles that this render has");
        return reader;
    }

    // Reads the plan of a file and makes it the film's, with the rates of the film's own tiles.
    static void take_plan(transport::FilmReader& reader, Film& film) {
        SamplePlan plan = reader.finish();
        const std::vector<float> rates = std::move(plan.rates);
        plan.rates.clear();
        film.plan() = std::move(plan);
        if (!rates.empty()) film.set_rates(reader.tiles(), rates);
    }

    std::mutex& tile_mutex(std::uint32_t tile) const { return tile_mutexes_[tile % tile_mutexes_.size()]; }

    // Renders until the mean number of samples per pixel is `most`, the error is reached or the render is stopped.
    StoppedBy run_to(int most, std::optional<double> error) {
        begin_run(most, error);
        struct End {
            Impl& impl;
            ~End() { impl.end_run(); }
        };
        {
            const End end{*this};
            with_threads(settings_.threads, [this] { run_passes(); });
        }
        if (!interrupted_) {
            finished_ = true;
            report(true);
        }
        return stopped_by();
    }

    void begin_run(int most, std::optional<double> error) {
        const std::scoped_lock lock(plan_mutex_);
        most_samples_ = most;
        error_ = error;
        start_ = Clock::now();
        is_running_ = true;
        interrupted_ = timed_out_ = reached_ = finished_ = false;
        last_report_ = last_fraction_ = 0;
        samples_done_ = film_.all_samples();
        context_.emplace();
    }

    void end_run() {
        const std::scoped_lock lock(plan_mutex_);
        film_.set_seconds(film_.seconds() + seconds_of_run());
        is_running_ = false;
    }

    void run_passes() {
        report(true);
        for (;;) {
            const int samples = film_.plan().samples;
            if (samples > 0) {
                // Take the samples that the plan wants, and check the error if this number of samples is a check.
                render_pass();
                if (ended()) return;
                if (error_ && transport::next_check(samples - 1, film_.plan().upper_error, *error_) == samples)
                    check_error();
            }
            if (ended() || samples >= most_samples_) return;
            begin_pass(next_samples(samples));
        }
    }

    // Returns the number of samples per pixel at the end of the next pass.
    int next_samples(int samples) const {
        if (samples < SamplePlan::kFirstPass) return std::min(SamplePlan::kFirstPass, most_samples_);
        const int pass = std::min({samples, kLargestPass, most_samples_ - samples});
        const int check = error_ ? transport::next_check(samples, film_.plan().upper_error, *error_) : most_samples_;
        return std::min(samples + pass, check);
    }

    // Makes the plan of a pass that ends at so many samples per pixel. Runs while no pass does.
    void begin_pass(int samples) {
        const SamplePlan& plan = film_.plan();
        if (!film_.is_whole() && !plan.rates.empty())
            throw ArgumentError("render: a shard whose pixels have rates goes on by a plan alone");
        // Compute the rates after the first pass, if the render is adaptive.
        std::vector<float> rates;
        const bool adapts = (settings_.error || settings_.time_limit) && !settings_.uniform;
        if (adapts && plan.rates.empty() && samples > SamplePlan::kFirstPass) rates = transport::sample_rates(film_);
        const std::span<const float> all = plan.rates.empty() ? rates : plan.rates;
        const double scale = all.empty() ? 0 : transport::scale_for(film_, all, samples, samples == most_samples_);
        // Set the plan. Only this needs the lock.
        const std::scoped_lock lock(plan_mutex_);
        if (!rates.empty()) film_.plan().rates = std::move(rates);
        film_.plan().samples = samples;
        film_.plan().scale = scale;
    }

    // Takes the samples that the plan wants and the pixels don't have yet.
    void render_pass() {
        const bool may_end = film_.plan().samples > SamplePlan::kFirstPass;
        for_each_until_cancelled(film_.tiles().size(), *context_, [&](std::size_t i) {
            if (interrupted_) return;
            // The first pass is completed even after the time limit, so that there is a picture and an estimate.
            if (settings_.time_limit && may_end && seconds_of_run() >= *settings_.time_limit) timed_out_ = true;
            if (timed_out_) return;
            const std::uint32_t tile = film_.tiles()[i];
            renderer_.render(film_, tile, tile_mutex(tile), samples_done_);
            report(false);
        });
        if (context_->is_group_execution_cancelled())
            interrupted_ = true;  // by report(), or by the caller's own task group
    }

    void check_error() {
        const ErrorEstimate e = transport::check_error(film_);
        const double upper = e.reason.empty() ? e.ci95_high : std::numeric_limits<double>::infinity();
        reached_ = upper <= *error_;
        const int samples = film_.plan().samples;
        // Guess the number of samples at which the target is reached, assuming that the error falls as 1 / samples.
        samples_needed_ = samples * std::max(1.0, upper / *error_);
        if (!transport::is_milestone(samples)) return;
        const std::scoped_lock lock(plan_mutex_);
        film_.plan().upper_error = upper;
    }

    bool ended() const { return interrupted_ || reached_ || timed_out_; }
    StoppedBy stopped_by() const {
        return interrupted_ ? StoppedBy::callback
               : reached_   ? StoppedBy::error
               : timed_out_ ? StoppedBy::time
                            : StoppedBy::samples;
    }

    double seconds_of_run() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

    // Calls the progress callback, at most every 50 ms unless `always` is true. Interrupts the render if it says so.
    // Does nothing if another thread is calling it.
    void report(bool always) {
        if (!settings_.progress) return;
        if (interrupted_ || reporting_.test_and_set(std::memory_order_acquire)) return;
        struct Finish {
            std::atomic_flag& flag;
            ~Finish() { flag.clear(std::memory_order_release); }
        } const finish{reporting_};
        const double now = seconds_of_run();
        if (!always && now - last_report_ < 0.05) return;
        last_report_ = now;
        last_fraction_ = std::max(last_fraction_, fraction(now));
        if (!settings_.progress({last_fraction_, now}) && !finished_) {
            interrupted_ = true;
            context_->cancel_group_execution();
        }
    }

    // Returns the fraction of the render that is done, by the limit that is expected to end the render first.
    double fraction(double now) const {
        const double samples = static_cast<double>(samples_done_) / static_cast<double>(film_.own_pixels());
        double fraction = samples / most_samples_;
        if (settings_.time_limit) fraction = std::max(fraction, now / *settings_.time_limit);
        if (error_) fraction = std::max(fraction, samples / samples_needed_);
        return finished_ ? 1 : samples_done_ == 0 ? 0 : std::min(fraction, 1.0);
    }

    const CompiledScene& scene_;
    const RenderSettings settings_;
    Film film_;
    const transport::TileRenderer renderer_;
    bool is_planned_ = false;  // the plan was loaded by load_plan

    // A thread that adds to a tile or saves it holds the tile's mutex: see tile_mutex.
    mutable std::array<std::mutex, 64> tile_mutexes_;
    // A thread that saves the plan, or changes it while the job runs, holds this mutex.
    mutable std::mutex plan_mutex_;

    // The state of the current or last run.
    int most_samples_ = 0;         // mean samples per pixel at which the run ends
    std::optional<double> error_;  // the target error
    Clock::time_point start_;
    bool is_running_ = false, reached_ = false, finished_ = false;
    std::atomic<bool> interrupted_ = false, timed_out_ = false;
    std::optional<tbb::task_group_context> context_;
    double samples_needed_ = 128 * SamplePlan::kFirstPass;  // mean samples per pixel at the target error, guessed
    std::atomic<std::uint64_t> samples_done_ = 0;
    // Set while a thread is in report(). It is not a mutex, because a callback that uses TBB may enter report() again
    // on the same thread.
    std::atomic_flag reporting_;
    double last_report_ = 0, last_fraction_ = 0;
};

RenderJob::RenderJob(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings)
    : impl_(with_threads(0, [&] { return std::make_unique<Impl>(scene, camera, settings); })) {}
RenderJob::~RenderJob() = default;
bool RenderJob::load(const std::string& path) { return impl_->load(path); }
void RenderJob::load_plan(const std::string& path) { impl_->load_plan(path); }
StoppedBy RenderJob::run() { return impl_->run(); }
StoppedBy RenderJob::add_samples(int count) { return impl_->add_samples(count); }
void RenderJob::save(const std::string& path) const { impl_->save(path); }
Image RenderJob::image() const { return impl_->image(); }
std::vector<float> RenderJob::alpha() const { return impl_->alpha(); }
const Film& RenderJob::film() const { return impl_->film(); }
RenderResult RenderJob::result() const { return impl_->result(); }

RenderResult render(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings) {
    RenderJob job(scene, camera, settings);
    job.run();
    return job.result();
}

}  // namespace limn
