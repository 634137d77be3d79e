#include "render_job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "interrupt.h"
#include "limn/core/error.h"
#include "limn/io/image_io.h"
#include "limn/render/compiled_scene.h"
#include "limn/render/render.h"
#include "progress_bar.h"
#include "report.h"
#include "text_file.h"

namespace limn::app {

namespace {

void check_outputs(const RenderJob& job, const RenderOptions& options) {
    check_distinct(options.all_outputs(), job.inputs);
    for (const std::string& path : options.outputs) check_writable(path);
    if (!options.report.empty()) check_text_path(options.report);
}

void check_channels(const RenderOptions& options) {
    const auto has_place = [](const std::string& path) { return image_holds_layers(path); };
    if (!options.channels.empty() && std::none_of(options.outputs.begin(), options.outputs.end(), has_place))
        throw ArgumentError("--channels: only an EXR has a place for them, and none is written");
}

// A lamp brighter than half can hold must not cost the picture.
Image clamped_to_half(Image image, const Console& console) {
    constexpr float kLargestHalf = 65504;
    std::size_t clamped = 0;
    for (float& value : image.values()) {
        if (value <= kLargestHalf) continue;
        value = kLargestHalf;
        ++clamped;
    }
    if (clamped > 0) console.error(fmt::format("--half: {} values above 65504 were saved as 65504", clamped));
    return image;
}

// Below eight samples a pixel no error is known: then that channel is NaN.
std::vector<ImageLayer> layers_of(const PixelMaps& maps, const RenderOptions& options) {
    std::vector<ImageLayer> layers;
    for (const std::string& name : options.channels) {
        std::vector<float> values = name == "error" ? maps.error : maps.samples;
        values.resize(maps.samples.size(), std::numeric_limits<float>::quiet_NaN());
        layers.push_back({name, std::move(values)});
    }
    return layers;
}

// Saves each output whatever becomes of the others: hours of rendering may be in them. Returns whether all were saved.
bool save_all(const RenderResult& result, const RenderSettings& settings, const RenderOptions& options,
              const Console& console) {
    const std::vector<ImageLayer> layers = layers_of(result.maps, options);
    const SaveOptions save{
        .half = options.half, .facts = picture_facts(result, settings, options.command_line), .layers = layers};
    const Image image = options.half ? clamped_to_half(result.image, console) : result.image;
    bool all = true;
    for (const std::string& path : options.outputs) try {
            save_image(image, path, save);
        } catch (const Error& e) {
            console.error(e.what());
            all = false;
        }
    return all;
}

std::string summary(const RenderResult& result, const RenderOptions& options) {
    const RenderReport& r = result.report;
    const ErrorEstimate& e = result.error;
    const std::string error =
        e.reason.empty() ? fmt::format("relMSE {:.2g}, at most {:.2g}", e.estimate, e.ci95_high) : e.reason;
    const std::string missed = e.target && !e.reached ? fmt::format("; {:.2g} was not reached", *e.target) : "";
    return fmt::format("{}{}: {}x{}, {:.4g} samples a pixel, {:.2f} s, {}{}", r.complete ? "" : "interrupted; ",
                       fmt::join(options.outputs, ", "), r.width, r.height, r.samples_per_pixel, r.render_seconds,
                       error, missed);
}

int interrupted_status() { return 128 + caught_signal(); }

}  // namespace

int run_render_job(const RenderJob& job, const RenderOptions& options, const Console& console) {
    check_camera_alone(options.camera);
    check_channels(options);
    check_outputs(job, options);
    catch_interrupts();

    Figure figure = from_files(job.make);
    figure.scene.name = figure.name;
    apply(options, figure);
    CameraRays(figure.camera, figure.settings.width, figure.settings.height);  // refuses an impossible camera
    const CompiledScene scene = from_files([&] { return compile(figure.scene); });

    ProgressBar bar(!options.quiet && stderr_is_terminal());
    figure.settings.progress = [&bar](const Progress& progress) {
        bar.update(progress);
        return caught_signal() == 0;
    };
    const RenderResult result = render(scene, figure.camera, figure.settings);
    bar.clear();
    if (result.report.samples_per_pixel == 0) {
        console.error("interrupted before the first sample: nothing was saved");
        return interrupted_status();
    }

    const auto begin = std::chrono::steady_clock::now();
    const bool saved = save_all(result, figure.settings, options, console);
    const std::chrono::duration<double> save_seconds = std::chrono::steady_clock::now() - begin;
    if (saved) console.note(summary(result, options));
    if (!options.report.empty()) write_text(options.report, report_json(result, save_seconds.count()));
    if (!saved) return kFailed;
    return result.report.complete ? kDone : interrupted_status();
}

}  // namespace limn::app
