#include "render_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "limn/core/error.h"

namespace limn::app {

namespace {

constexpr int kMostSamples = std::numeric_limits<int>::max();
constexpr int kMostThreads = 1024;

// Stands for what only the scene can tell: see state_presets.
constexpr const char* kOfScene = "the scene's own";

double parse_positive(const char* option, const std::string& text) {
    const double value = parse_number(option, text);
    if (!(value > 0)) refuse(option, text, "must be over 0");
    return value;
}

void add_numbers(Options& options, RenderOptions& o) {
    options.add({.name = "--size", .value = "WxH", .help = "Size in pixels", .preset = kOfScene},
                [&o](const std::string& s) { o.size = parse_size("--size", s); });
    options.add({.name = "--spp",
                 .value = "N",
                 .help = "Samples a pixel; with --error or --time-limit the upper limit of their average",
                 .preset = kOfScene},
                [&o](const std::string& s) { o.samples_per_pixel = parse_integer("--spp", s, 1, kMostSamples); });
    options.add({.name = "--error",
                 .value = "E",
                 .help = "Render until the picture's relMSE is at most E, by the upper end of its 95 % interval; --spp "
                         "is then the upper limit",
                 .preset = "--spp ends the render"},
                [&o](const std::string& s) { o.error = parse_positive("--error", s); });
    options.add({.name = "--time-limit",
                 .value = "SECONDS",
                 .help = "Render no longer than that, with --error until the first of both; --spp is then the upper "
                         "limit",
                 .preset = "none"},
                [&o](const std::string& s) { o.time_limit = parse_positive("--time-limit", s); });
    options.add_flag("--uniform", o.uniform,
                     "The same number of samples in every pixel (with --error or --time-limit)");
    options.add({.name = "--seed",
                 .value = "N",
                 .help = "Another seed gives other noise, the same seed the same picture",
                 .preset = kOfScene},
                [&o](const std::string& s) {
                    o.seed = parse_integer<std::uint64_t>("--seed", s, 0, std::numeric_limits<std::uint64_t>::max());
                });
    options.add({.name = "--threads",
                 .value = "N",
                 .help = "Threads, on which the picture does not depend",
                 .preset = "one for each processor"},
                [&o](const std::string& s) { o.threads = parse_integer("--threads", s, 1, kMostThreads); });
    options.add({.name = "--max-depth", .value = "N|unlimited", .help = "Ray segments a path", .preset = kOfScene},
                [&o](const std::string& s) {
                    o.max_depth =
                        s == "unlimited" ? kUnlimitedDepth : parse_integer("--max-depth", s, 1, kUnlimitedDepth - 1);
                });
    options.add({.name = "--estimator",
                 .value = "path|naive",
                 .help = "How light is found: with or without sampling the lamps",
                 .preset = kOfScene},
                [&o](const std::string& s) {
                    if (s != "path" && s != "naive") refuse("--estimator", s, "must be path or naive");
                    o.estimator = s == "path" ? Estimator::path : Estimator::naive;
                });
    options.add({.name = "--sampler",
                 .value = "sobol|independent",
                 .help = "Random numbers: spread evenly over each pixel's samples, or independent",
                 .preset = kOfScene},
                [&o](const std::string& s) {
                    if (s != "sobol" && s != "independent") refuse("--sampler", s, "must be sobol or independent");
                    o.sampler = s == "sobol" ? SamplerKind::sobol : SamplerKind::independent;
                });
}

// Names of channels with commas between them, each once.
std::vector<std::string> parse_channels(const std::string& text) {
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string name = text.substr(begin, end - begin);
        if (name != "error" && name != "samples") refuse("--channels", text, "must be error, samples or error,samples");
        if (std::find(names.begin(), names.end(), name) != names.end()) refuse("--channels", text, "names one twice");
        names.push_back(name);
        begin = end + 1;
    }
    return names;
}

void add_camera(Options& options, CameraOptions& o) {
    const auto add = [&options](const char* name, const char* value, const char* help, const Use& use) {
        options.add({.name = name, .value = value, .help = help, .preset = kOfScene, .group = "Camera"}, use);
    };
    add("--look-from", "x,y,z", "Where the eye is", [&o](const std::string& s) {
        const auto [x, y, z] = parse_triple("--look-from", s);
        o.look_from = Point3{x, y, z};
    });
    add("--look-at", "x,y,z", "What is in the middle of the picture", [&o](const std::string& s) {
        const auto [x, y, z] = parse_triple("--look-at", s);
        o.look_at = Point3{x, y, z};
    });
    add("--vup", "x,y,z", "What is up in the picture", [&o](const std::string& s) {
        const auto [x, y, z] = parse_triple("--vup", s);
        o.up = Vec3{x, y, z};
        if (*o.up == Vec3{}) refuse("--vup", s, "must not be zero");
    });
    add("--vfov", "DEG", "Full angle between the top and the bottom of the picture", [&o](const std::string& s) {
        o.vertical_fov = parse_number("--vfov", s);
        if (!(*o.vertical_fov > 0 && *o.vertical_fov < 180))
            refuse("--vfov", s, "must be over 0 and under 180 degrees");
    });
    add("--aperture-angle", "DEG", "Full angle of the lens seen from the plane in focus; 0: all is sharp",
        [&o](const std::string& s) {
            o.aperture_angle = parse_number("--aperture-angle", s);
            if (!(*o.aperture_angle >= 0 && *o.aperture_angle < 180))
                refuse("--aperture-angle", s, "must be at least 0 and under 180 degrees");
        });
    add("--focus-dist", "D", "Distance of the plane in focus", [&o](const std::string& s) {
        o.focus_distance = parse_number("--focus-dist", s);
        if (!(*o.focus_distance > 0)) refuse("--focus-dist", s, "must be positive");
    });
}

template <class Target, class Value>
void replace(Target& target, const std::optional<Value>& value) {
    if (value) target = *value;
}

void replace_camera(Camera& camera, const CameraOptions& o) {
    replace(camera.look_from, o.look_from);
    replace(camera.look_at, o.look_at);
    replace(camera.up, o.up);
    replace(camera.vertical_fov, o.vertical_fov);
    replace(camera.aperture_angle, o.aperture_angle);
    replace(camera.focus_distance, o.focus_distance);
}

}  // namespace

void add_render_options(Options& options, RenderOptions& o, const std::string& outputs) {
    options.add({.name = "-o,--output",
                 .value = "FILE",
                 .help = "A picture to write, .exr or .png; may be repeated",
                 .preset = outputs,
                 .required = outputs.empty(),
                 .repeatable = true},
                picture_names("-o", o.outputs));
    add_numbers(options, o);
    options.add_flag("--no-antialias", o.no_antialias, "Rays through the centres of pixels only");
    options.add(
        {.name = "--channels",
         .value = "error,samples",
         .help = "Channels that an EXR gets beside its colours: each pixel's estimated relMSE, how many samples "
                 "it has",
         .preset = "none"},
        [&o](const std::string& s) { o.channels = parse_channels(s); });
    options.add_flag("--half", o.half, "EXR with 16 bits a value instead of 32");
    options.add({.name = "--report",
                 .value = "FILE.json",
                 .help = "Write what was done and how well as JSON; - for standard output",
                 .preset = "none"},
                file_name("--report", o.report));
    options.add_flag("--quiet", o.quiet, "Say nothing but errors");
    add_camera(options, o.camera);
    // Refused, so that no script comes to rely on their absence.
    for (const char* name : {"--shard", "--checkpoint", "--resume"}) options.reserve(name);
}

void state_presets(Options& options, const Figure& figure) {
    const RenderSettings& s = figure.settings;
    const Camera& c = figure.camera;
    const auto triple = [](const auto& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); };
    options.preset("--size", fmt::format("{}x{}", s.width, s.height));
    options.preset("--spp",
                   fmt::format("{}; {} with --error or --time-limit", s.samples_per_pixel, s.max_samples_per_pixel));
    options.preset("--seed", fmt::format("{}", s.seed));
    options.preset("--max-depth", s.max_depth == kUnlimitedDepth ? "unlimited" : fmt::format("{}", s.max_depth));
    options.preset("--estimator", s.estimator == Estimator::path ? "path" : "naive");
    options.preset("--sampler", s.sampler == SamplerKind::sobol ? "sobol" : "independent");
    options.preset("--look-from", triple(c.look_from));
    options.preset("--look-at", triple(c.look_at));
    options.preset("--vup", triple(c.up));
    options.preset("--vfov", fmt::format("{}", c.vertical_fov));
    options.preset("--aperture-angle", fmt::format("{}", c.aperture_angle));
    options.preset("--focus-dist", c.focus_distance ? fmt::format("{}", *c.focus_distance) : "that of --look-at");
}

void apply(const RenderOptions& o, Figure& figure) {
    RenderSettings& settings = figure.settings;
    if (o.size) {
        settings.width = o.size->width;
        settings.height = o.size->height;
        figure.camera.aspect_ratio.reset();  // that of the new size
    }
    replace(settings.samples_per_pixel, o.samples_per_pixel);
    replace(settings.max_samples_per_pixel, o.samples_per_pixel);
    if (o.error) settings.error = o.error;
    if (o.time_limit) settings.time_limit = o.time_limit;
    if (o.uniform) settings.uniform = true;
    replace(settings.seed, o.seed);
    replace(settings.threads, o.threads);
    replace(settings.max_depth, o.max_depth);
    replace(settings.estimator, o.estimator);
    replace(settings.sampler, o.sampler);
    if (o.no_antialias) settings.antialias = false;
    replace_camera(figure.camera, o.camera);
}

std::vector<std::string> RenderOptions::all_outputs() const {
    std::vector<std::string> all = outputs;
    if (!report.empty()) all.push_back(report);
    return all;
}

void check_camera_alone(const CameraOptions& o) {
    if (!o.look_from || !o.look_at) return;
    if (!o.up && *o.look_from != *o.look_at) return;
    Camera camera;
    replace_camera(camera, o);
    CameraRays(camera, 1, 1);
}

std::string command_line(int argc, const char* const* argv) {
    constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
    std::string line;
    for (int i = 0; i < argc; ++i) {
        if (i > 0) line += ' ';
        const std::string word = argv[i];
        if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
            line += word;
            continue;
        }
        line += '\'';
        for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
        line += '\'';
    }
    return line;
}

}  // namespace limn::app
