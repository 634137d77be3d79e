#include "picture_output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <limits>
#include <utility>

#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "parse.h"
#include "report.h"
#include "text_file.h"

namespace limn::app {

namespace {

constexpr const char* kOfFirstHits = "albedo, normal, position, depth, object, primitive";

// Parses a list of different names of channels, separated by commas.
std::vector<std::string> parse_channels(const std::string& text, bool has_scene) {
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string name = text.substr(begin, end - begin);
        const bool is_of_film = name == "error" || name == "samples";
        if (!has_scene && !is_of_film)
            refuse(
                "--channels", text,
                "only error and samples are possible: the other channels need the scene, which a film does not store");
        if (!is_of_film && !FirstHits::knows(name))
            refuse("--channels", text, fmt::format("each name must be one of error, samples, {}", kOfFirstHits));
        if (std::find(names.begin(), names.end(), name) != names.end())
            refuse("--channels", text, "names a channel twice");
        names.push_back(name);
        begin = end + 1;
    }
    return names;
}

// Replaces values above 65504, the largest half, by 65504. Otherwise save_image would throw, and a picture of a bright
// lamp would not be saved.
Image clamped_to_half(Image image, const Console& console) {
    constexpr float kLargestHalf = 65504;
    std::size_t clamped = 0;
    for (float& value : image.values()) {
        if (!(value > kLargestHalf)) continue;
        value = kLargestHalf;
        ++clamped;
    }
    if (clamped > 0) console.error(fmt::format("--half: {} values above 65504 were saved as 65504", clamped));
    return image;
}

// Returns the channels that --channels names. If there is no estimate, all values of "error" are NaN.
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

// Saves all pictures. Returns true if all were saved; errors are printed.
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

// Returns the line that is printed at the end.
std::string summary(const RenderResult& result, const FilmInfo& info, const PictureOptions& options) {
    const RenderReport& r = result.report;
    const ErrorEstimate& e = result.error;
    const std::string error =
        e.reason.empty() ? fmt::format("relMSE {:.2g}, at most {:.2g}", e.estimate, e.ci95_high) : e.reason;
    const std::string missed =
        e.target && !e.reached ? fmt::format("; the target {:.2g} was not reached", *e.target) : "";
    std::vector<std::string> files = options.outputs;
    if (!options.film.empty()) files.push_back(options.film);
    if (files.empty()) files.push_back(info.scene);  // neither a picture nor a film is written: name the scene instead
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
    // Add the files of pictures and film.
    options.add({.name = "-o,--output",
                 .value = "FILE",
                 .help = "A picture to write, .exr or .png; may be repeated",
                 .preset = outputs.empty() ? "none" : outputs,
                 .repeatable = true},
                picture_names("-o", o.outputs));
    options.add({.name = "--film",
                 .value = "FILE",
                 .help = "Write the film, which --resume and limn merge read. With --film alone no picture is written; "
                         "add -o for one",
                 .preset = "none"},
                file_name("--film", o.film));
    // Add the contents of pictures.
    options.add({.name = "--channels",
                 .value = "LIST",
                 .help = fmt::format(
                     "Further channels of an EXR, separated by commas: error, each pixel's estimated relMSE; samples, "
                     "its number of samples{}",
                     has_scene ? fmt::format("; {} of the surface that the camera sees first", kOfFirstHits)
                               : ". The other channels of limn render need the scene, which is not in a film"),
                 .preset = "none"},
                [&o, has_scene](const std::string& s) { o.channels = parse_channels(s, has_scene); });
    options.add(
        {.name = "--exposure", .value = "STOPS", .help = "Multiply the colours of a PNG by 2^STOPS", .preset = "0"},
        [&o](const std::string& s) { o.exposure = parse_number("--exposure", s); });
    options.add_flag("--half", o.half,
                     "Write the colours of an EXR with 16 bits a value instead of 32; further channels keep 32");
    // Add what is printed or reported.
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
        throw ArgumentError("--channels: only an EXR can store channels, and no -o names an EXR");
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
    // Save the pictures and measure the time.
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
    // Print the summary and write the report.
    if (saved) console.note(summary(result, info, options));
    if (!options.report.empty()) write_text(options.report, report_json(result, seconds.count()));
    return saved;
}

}  // namespace limn::app
