#include "picture_output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <limits>
#include <utility>

#include "limn/core/error.h"
#include "limn/io/image_io.h"
#include "parse.h"
#include "report.h"
#include "text_file.h"

namespace limn::app {

namespace {

constexpr const char* kOfFirstHits = "albedo, normal, position, depth, object, primitive";

// Names of channels with commas between them, each once.
std::vector<std::string> parse_channels(const std::string& text, bool has_scene) {
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string name = text.substr(begin, end - begin);
        const bool is_of_film = name == "error" || name == "samples";
        if (!has_scene && !is_of_film)
            refuse("--channels", text, "must be of error, samples: the others are of the scene, which no film holds");
        if (!is_of_film && !FirstHits::knows(name))
            refuse("--channels", text, fmt::format("must be of error, samples, {}", kOfFirstHits));
        if (std::find(names.begin(), names.end(), name) != names.end()) refuse("--channels", text, "names one twice");
        names.push_back(name);
        begin = end + 1;
    }
    return names;
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
std::vector<ImageLayer> layers_of(const PixelMaps& maps, const std::optional<FirstHits>& hits,
                                  const PictureOptions& options) {
    std::vector<ImageLayer> layers;
    for (const std::string& name : options.channels) {
        if (FirstHits::knows(name)) {
            std::ranges::move(hits.value().layers(name), std::back_inserter(layers));
            continue;
        }
        std::vector<float> values = name == "error" ? maps.error : maps.samples;
        values.resize(maps.samples.size(), std::numeric_limits<float>::quiet_NaN());
        layers.push_back({name, std::move(values)});
    }
    return layers;
}

std::optional<PartOf> part_of(const FilmInfo& info) {
    if (!info.crop) return {};
    return PartOf{info.crop->left, info.crop->top, info.width, info.height};
}

bool save_images(const Image& image, const SaveOptions& save, const PictureOptions& options, const Console& console) {
    bool all = true;
    for (const std::string& path : options.outputs) try {
            save_image(image, path, save);
        } catch (const Error& e) {
            console.error(e.what());
            all = false;
        }
    return all;
}

std::string summary(const RenderResult& result, const FilmInfo& info, const PictureOptions& options) {
    const RenderReport& r = result.report;
    const ErrorEstimate& e = result.error;
    const std::string error =
        e.reason.empty() ? fmt::format("relMSE {:.2g}, at most {:.2g}", e.estimate, e.ci95_high) : e.reason;
    const std::string missed = e.target && !e.reached ? fmt::format("; {:.2g} was not reached", *e.target) : "";
    std::vector<std::string> files = options.outputs;
    if (!options.film.empty()) files.push_back(options.film);
    if (files.empty()) files.push_back(info.scene);  // a checkpoint or a plan alone is written
    return fmt::format("{}{}: {}x{}, {:.4g} samples a pixel, {:.2f} s, {}{}", r.complete ? "" : "interrupted; ",
                       fmt::join(files, ", "), r.width, r.height, r.samples_per_pixel, r.render_seconds, error, missed);
}

}  // namespace

std::vector<std::string> PictureOptions::all_outputs() const {
    std::vector<std::string> all = outputs;
    if (!report.empty()) all.push_back(report);
    if (!film.empty()) all.push_back(film);
    return all;
}

void add_picture_options(Options& options, PictureOptions& o, bool has_scene, const std::string& outputs) {
    options.add({.name = "-o,--output",
                 .value = "FILE",
                 .help = "A picture to write, .exr or .png; may be repeated",
                 .preset = outputs.empty() ? "none" : outputs,
                 .repeatable = true},
                picture_names("-o", o.outputs));
    options.add({.name = "--film",
                 .value = "FILE",
                 .help = "Write the film, which --resume and limn merge read; without -o no picture is written then",
                 .preset = "none"},
                file_name("--film", o.film));
    options.add({.name = "--channels",
                 .value = "LIST",
                 .help = fmt::format(
                     "Further channels of an EXR, with commas between them: error, each pixel's estimated relMSE; "
                     "samples, how many it has; {}",
                     has_scene ? fmt::format("of the surface that the camera sees first {}", kOfFirstHits)
                               : "the others of a render are of the scene, which no film holds"),
                 .preset = "none"},
                [&o, has_scene](const std::string& s) { o.channels = parse_channels(s, has_scene); });
    options.add({.name = "--exposure",
                 .value = "STOPS",
                 .help = "Show a PNG brighter, by 2 to the STOPS, or darker",
                 .preset = "0"},
                [&o](const std::string& s) { o.exposure = parse_number("--exposure", s); });
    options.add_flag("--half", o.half, "Write EXR with 16 bits a value instead of 32");
    options.add({.name = "--report",
                 .value = "FILE.json",
                 .help = "Write a report of the render as JSON; - for standard output",
                 .preset = "none"},
                file_name("--report", o.report));
    options.add_flag("--quiet", o.quiet, "Print errors only");
}

void check_picture_options(const PictureOptions& o) {
    const auto has_place = [](const std::string& path) { return image_holds_layers(path); };
    if (!o.channels.empty() && std::none_of(o.outputs.begin(), o.outputs.end(), has_place))
        throw ArgumentError("--channels: only an EXR has a place for them, and none is written");
    for (const std::string& path : o.outputs) check_writable(path);
    for (const std::string& path : {o.report, o.film})
        if (!path.empty()) check_text_path(path);
}

void save_preview(const RenderJob& job, const FilmInfo& info, const PictureOptions& options, const Console& console) {
    const SaveOptions save{.alpha = job.alpha(), .exposure = options.exposure, .part_of = part_of(info)};
    save_images(job.image(), save, options, console);
}

bool wants_first_hits(const PictureOptions& options) { return std::ranges::any_of(options.channels, FirstHits::knows); }

bool save_pictures(const RenderResult& result, const FilmInfo& info, const PictureOptions& options,
                   const Console& console, const std::optional<FirstHits>& hits) {
    const auto begin = std::chrono::steady_clock::now();
    bool saved = true;
    if (!options.outputs.empty()) {
        const SaveOptions save{.half = options.half,
                               .facts = picture_facts(result, info, options.command_line),
                               .layers = layers_of(result.maps, hits, options),
                               .alpha = result.maps.alpha,
                               .exposure = options.exposure,
                               .part_of = part_of(info)};
        saved =
            save_images(options.half ? clamped_to_half(result.image, console) : result.image, save, options, console);
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    if (saved) console.note(summary(result, info, options));
    if (!options.report.empty()) write_text(options.report, report_json(result, seconds.count()));
    return saved;
}

}  // namespace limn::app
