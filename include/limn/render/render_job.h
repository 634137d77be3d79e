/// \file
/// Renders that can be previewed, interrupted, saved and continued.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "limn/math/error.h"
#include "limn/render/film.h"
#include "limn/render/render.h"

namespace limn {

/// A render that can be interrupted, saved, loaded and continued. `render` is the short form. The film, and the error
/// at which the render ends, are those of an uninterrupted render, on any machine and with any number of threads.
/// \code
/// RenderJob job(scene, camera, settings);
/// if (std::filesystem::exists("a.film")) job.load("a.film");
/// job.run();
/// job.save("a.film");
/// \endcode
/// Only one thread at a time may call the member functions, except `save`, `image` and `alpha`. They throw what
/// `render` throws, and FileError as said below.
class RenderJob {
public:
    /// Makes a job with a black film. The scene must outlive the job.
    RenderJob(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings = {});
    ~RenderJob();
    RenderJob(const RenderJob&) = delete;
    RenderJob& operator=(const RenderJob&) = delete;

    /// Replaces the film of the job by the film in a file, from which the render continues. That film must have the
    /// tiles of the job's shard, and may have more.
    /// \return true if the job has all tiles of the film in the file
    /// \throws FileError as Film::load does, and if the film lacks tiles or belongs to another render (see FilmInfo).
    /// Threads, numbers of samples, error and time limit may differ. The job is then unchanged.
    bool load(const std::string& path);
    /// Reads a plan that plan_next_round wrote. `run` then renders the samples of the plan, whatever the settings say.
    /// \throws FileError as `load` does, and if the plan has fewer samples than the film or gives pixels other rates
    void load_plan(const std::string& path);

    /// Renders until the samples, the error, the time limit or the progress callback of the settings end the run. A
    /// later run continues where the last one ended, even if an exception ended it. The time limit holds for each run.
    /// \return why the run ended
    StoppedBy run();
    /// Renders `count` more samples per pixel, in the mean over the pixels. RenderSettings::error is ignored. If the
    /// last run was ended within a pass, the pass is completed first and does not count.
    /// \return why the run ended
    /// \throws ArgumentError if `count` is less than 1 or too large
    StoppedBy add_samples(int count);

    /// Writes the film to a file, which appears whole or not at all. Any thread may call it at any time. While the job
    /// runs, it writes the samples that each tile has at that moment.
    /// \throws FileError that names the file
    void save(const std::string& path) const;
    /// Return the current picture, and its alpha as in PixelMaps. Any thread may call them at any time.
    ///@{
    Image image() const;
    std::vector<float> alpha() const;
    ///@}

    const Film& film() const;     ///< returns the film. \pre the job is not running
    RenderResult result() const;  ///< returns picture, error and report. \pre the job is not running

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// Calls a function regularly, in a thread of its own, until the object is destroyed. It can show or save the picture
/// of a job while the job runs.
/// \code
/// const Repeated preview(5, [&] { save_image(job.image(), "a.png"); });
/// job.run();
/// \endcode
class Repeated {
public:
    /// Starts the thread. It waits `seconds` before each call. If the function throws an exception, the program is
    /// terminated.
    /// \throws ArgumentError if `seconds` is not positive
    Repeated(double seconds, std::function<void()> function);
    /// Ends the thread. If the function is running, waits until it returns.
    ~Repeated();
    Repeated(const Repeated&) = delete;
    Repeated& operator=(const Repeated&) = delete;

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// Saves the film of a job regularly, in a thread of its own, until the object is destroyed.
class Checkpoints {
public:
    /// Starts the thread. It waits `seconds` before each save. If a film cannot be written, it calls `failed` with the
    /// error, and the render continues. The job must outlive the object.
    /// \throws ArgumentError if `seconds` is not positive
    Checkpoints(const RenderJob& job, const std::string& path, double seconds,
                std::function<void(const Error&)> failed);
    /// Ends the thread. If it is saving, waits until the file is written.
    ~Checkpoints();
    Checkpoints(const Checkpoints&) = delete;
    Checkpoints& operator=(const Checkpoints&) = delete;

private:
    Repeated repeated_;
};

/// Writes a plan for RenderJob::load_plan: the number of samples per pixel that all shards are to render next. It is
/// for a merged film whose error is above the target.
/// \param film the merged film
/// \param error its error and target, from `render_result`
/// \param path the file of the plan
/// \throws FileError if the file cannot be written
/// \throws ArgumentError if there is no target, or if the film is not whole or has a pixel with fewer than 8 samples
void plan_next_round(const Film& film, const ErrorEstimate& error, const std::string& path);

}  // namespace limn
