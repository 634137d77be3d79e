#include "render_task.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "interrupt.h"
#include "limn/math/error.h"
#include "limn/math/system/file_lock.h"
#include "limn/math/system/files.h"
#include "limn/query/compiled_scene.h"
#include "limn/render/render_job.h"
#include "picture_output.h"
#include "progress_bar.h"
#include "text_file.h"

namespace limn::app {

namespace {

// Returns the paths of the films that this process writes.
std::vector<std::string> written_films(const RenderOptions& o) {
    std::vector<std::string> films;
    for (const std::string& path : {o.checkpoint, o.film})
        if (!path.empty()) films.push_back(path);
    return films;
}

// True if `film` is the file that --resume names.
bool is_continued(const RenderOptions& o, const std::string& film) {
    return !o.resume.empty() && file_behind_links(o.resume) == file_behind_links(film);
}

// True if the film that --resume names is also written.
bool is_replaced(const RenderOptions& o) {
    return std::ranges::any_of(written_films(o), [&](const std::string& film) { return is_continued(o, film); });
}

// Checks that outputs are different files, do not replace inputs and can be written.
void check_outputs(const RenderTask& task, const RenderOptions& options) {
    std::vector<std::string> inputs = task.inputs, outputs = options.all_outputs();
    inputs.push_back(options.plan);
    outputs.push_back(options.checkpoint);
    if (!is_replaced(options)) inputs.push_back(options.resume);
    check_distinct(outputs, inputs);
    check_picture_options(options);
    // Check that a checkpoint does not replace a film of another render.
    if (options.checkpoint.empty()) return;
    check_text_path(options.checkpoint);
    if (std::filesystem::exists(options.checkpoint) && !is_continued(options, options.checkpoint))
        throw FileError(options.checkpoint,
                        "exists: add --resume with the same file to continue its render, or remove it");
}

// Loads the film that --resume names. If the same film is also written, it need not exist yet, so that the same command
// can begin a render and continue it.
void load_film(RenderJob& job, const RenderOptions& options, const Console& console) {
    if (options.resume.empty()) return;
    if (is_replaced(options) && !std::filesystem::exists(options.resume))
        console.note(options.resume + ": does not exist yet; the render begins with the first sample");
    else if (!job.load(options.resume) && is_replaced(options))  // writing the film would lose its other tiles
        throw FileError(options.resume, "has more tiles than this --shard, and would be replaced by a part of itself");
}

// Returns true if the film was saved; an error is printed.
bool save_film(const RenderJob& job, const std::string& path, const Console& console) {
    try {
        job.save(path);
        return true;
    } catch (const Error& e) {
        console.error(e.what());
        return false;
    }
}

int interrupted_status() { return 128 + caught_signal(); }

}  // namespace

int run_render_task(const RenderTask& task, const RenderOptions& options, const Console& console) {
    // Check the options, and lock the films against other processes.
    check_camera_alone(options.camera);
    check_outputs(task, options);
    catch_interrupts();
    std::vector<std::unique_ptr<FileLock>> locks;
    for (const std::string& film : written_films(options)) locks.push_back(std::make_unique<FileLock>(film));

    // Read and compile the scene.
    Figure figure = task.make();
    figure.scene.name = figure.name;
    apply(options, figure);
    CameraRays(figure.camera, figure.settings.width, figure.settings.height);  // throws for an impossible camera
    const CompiledScene scene = from_files([&] { return compile(figure.scene); });

    // Make the job, with the film to resume and the plan.
    ProgressBar bar(!options.quiet && stderr_is_terminal());
    figure.settings.progress = [&bar](const Progress& progress) {
        bar.update(progress);
        return caught_signal() == 0;
    };
    RenderJob job(scene, figure.camera, figure.settings);
    load_film(job, options, console);
    if (!options.plan.empty()) job.load_plan(options.plan);
    const FilmInfo& info = job.film().info();

    // Render, with checkpoints and previews.
    {
        std::optional<Checkpoints> checkpoints;
        if (!options.checkpoint.empty())
            checkpoints.emplace(job, options.checkpoint, options.every.value_or(kEvery), [&](const Error& e) {
                bar.clear();
                console.error(std::string(e.what()) + "; the render goes on without this checkpoint");
            });
        std::optional<Repeated> previews;
        if (options.preview) previews.emplace(*options.preview, [&] { save_preview(job, info, options, console); });
        job.run();
    }
    bar.clear();
    if (job.film().all_samples() == 0) {
        console.error("interrupted before the first sample: nothing was saved");
        return interrupted_status();
    }

    // Save the films, the pictures and the report.
    bool saved = true;
    for (const std::string& film : written_films(options)) saved &= save_film(job, film, console);
    const RenderResult result = job.result();
    std::optional<FirstHits> hits;
    if (wants_first_hits(options)) hits = first_hits(scene, figure.camera, figure.settings);
    saved &= save_pictures(result, info, options, console, hits);
    if (!saved) return kFailed;
    return result.report.complete ? kDone : interrupted_status();
}

}  // namespace limn::app
