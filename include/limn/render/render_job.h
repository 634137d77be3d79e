/// \file
/// Renders that can be shown, paused, saved and continued.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "limn/core/error.h"
#include "limn/render/film.h"
#include "limn/render/render.h"

namespace limn {

/// A render of which `render` is the short form. However it is interrupted, saved, loaded and continued, on whatever
/// machine and number of threads: its film, and the error at which it stops, are those of an uninterrupted render.
/// \code
/// RenderJob job(scene, camera, settings);
/// if (std::filesystem::exists("a.film")) job.load("a.film");
/// job.run();
/// job.save("a.film");
/// \endcode
/// The functions are for one thread at a time, but for those that say otherwise. They throw what `render` throws.
class RenderJob {
public:
    /// The scene must outlive the job.
    RenderJob(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings = {});
    ~RenderJob();
    RenderJob(const RenderJob&) = delete;
    RenderJob& operator=(const RenderJob&) = delete;

    /// Continues from a film instead of the job's own. It may have more tiles than the job's shard.
    /// \throws FileError as Film::load; also if it is of another scene or camera, or other settings but for threads,
    /// samples, error and time limit; the job is then as before
    /// \return whether the job has all of the film's tiles
    bool load(const std::string& path);
    /// Renders what a plan wants instead of what the settings say. \throws FileError as `load`
    void load_plan(const std::string& path);

    /// Renders until something of the settings ends it. Continues where it was ended before, by a time limit (which
    /// begins anew), the callback or an exception.
    StoppedBy run();
    /// So many samples more in the mean over pixels, from 1 on, whatever the error is: beyond the pass that was begun,
    /// which is finished first where something ended it.
    StoppedBy add_samples(int count);

    /// Writes the film to a file, which appears whole or not at all. By any thread, at any time: while the job runs,
    /// the film is that of some moment of it. \throws FileError
    void save(const std::string& path) const;
    /// The picture so far, and its alpha as in PixelMaps. By any thread, at any time.
    ///@{
    Image image() const;
    std::vector<float> alpha() const;
    ///@}

    const Film& film() const;     ///< not while it runs
    RenderResult result() const;  ///< not while it runs

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// Calls a function regularly, in a thread of its own, as long as this object lives: to show or save what a job has so
/// far.
/// \code
/// const Repeated preview(5, [&] { save_image(job.image(), "a.png"); });
/// job.run();
/// \endcode
class Repeated {
public:
    /// Every `seconds`. What the function throws ends the program. \throws ArgumentError if seconds are not over 0
    Repeated(double seconds, std::function<void()> function);
    /// Waits for a call that runs, and makes no more.
    ~Repeated();
    Repeated(const Repeated&) = delete;
    Repeated& operator=(const Repeated&) = delete;

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// Saves a job's film regularly, in a thread of its own, as long as this object lives.
class Checkpoints {
public:
    /// Every `seconds`. The job must outlive the object. `failed` is called by that thread with what was wrong
    /// when a film could not be written; the render continues. \throws ArgumentError if seconds are not over 0
    Checkpoints(const RenderJob& job, const std::string& path, double seconds,
                std::function<void(const Error&)> failed);
    /// Waits for a save that is under way, and begins no other.
    ~Checkpoints();
    Checkpoints(const Checkpoints&) = delete;
    Checkpoints& operator=(const Checkpoints&) = delete;

private:
    Repeated repeated_;
};

/// Writes to `path` how many samples per pixel each shard needs next, for RenderJob::load_plan. For a film whose error,
/// as `render_result` estimates it, is over its target. \throws FileError; ArgumentError if there is no
/// target, the film is not whole or has too few samples
void plan_next_round(const Film& film, const ErrorEstimate& error, const std::string& path);

}  // namespace limn
