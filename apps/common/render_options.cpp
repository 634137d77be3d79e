#include "render_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <limits>

#include "limn/core/error.h"

namespace limn::app {

namespace {

constexpr int kMostSamples = std::numeric_limits<int>::max();
constexpr int kMostThreads = 1024;

using Use = std::function<void(const std::string& text)>;

CLI::Option* add(CLI::App& app, const std::string& name, const std::string& type, const std::string& help,
                 const Use& use) {
    return app.add_option_function<std::string>(name, use, help)->type_name(type);
}

double parse_positive(const char* option, const std::string& text) {
    const double value = parse_number(option, text);
    if (!(value > 0)) refuse(option, text, "must be over 0");
    return value;
}

void add_numbers(CLI::App& app, RenderOptions& o) {
    add(app, "--size", "WxH", "Size in pixels", [&o](const std::string& s) { o.size = parse_size("--size", s); });
    add(app, "--spp", "N", "Samples per pixel",
        [&o](const std::string& s) { o.samples_per_pixel = parse_integer("--spp", s, 1, kMostSamples); });
    add(app, "--error", "E",
        "Render until the picture's relMSE is at most E, by the upper end of its 95 % interval; --spp is then the most",
        [&o](const std::string& s) { o.error = parse_positive("--error", s); });
    add(app, "--time-limit", "SECONDS",
        "Render no longer than that, with --error until the first of both; --spp is then the most",
        [&o](const std::string& s) { o.time_limit = parse_positive("--time-limit", s); });
    app.add_flag("--uniform", o.uniform, "With --error or --time-limit: as many samples in each pixel");
    add(app, "--seed", "N", "Another seed gives other noise, the same seed the same picture",
        [&o](const std::string& s) {
            o.seed = parse_integer<std::uint64_t>("--seed", s, 0, std::numeric_limits<std::uint64_t>::max());
        });
    add(app, "--threads", "N", "Threads; by default one a processor. The picture does not depend on it",
        [&o](const std::string& s) { o.threads = parse_integer("--threads", s, 1, kMostThreads); });
    add(app, "--max-depth", "N|unlimited", "Ray segments a path", [&o](const std::string& s) {
        o.max_depth = s == "unlimited" ? kUnlimitedDepth : parse_integer("--max-depth", s, 1, kUnlimitedDepth - 1);
    });
    add(app, "--estimator", "path|naive", "How light is found: with or without sampling the lamps",
        [&o](const std::string& s) {
            if (s != "path" && s != "naive") refuse("--estimator", s, "must be path or naive");
            o.estimator = s == "path" ? Estimator::path : Estimator::naive;
        });
    add(app, "--sampler", "sobol|independent",
        "Random numbers: spread evenly over each pixel's samples, or independent", [&o](const std::string& s) {
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

void add_camera(CLI::App& app, CameraOptions& o) {
    const auto option = [&app](const std::string& name, const std::string& type, const std::string& help,
                               const Use& use) { add(app, name, type, help, use)->group("Camera"); };
    option("--look-from", "x,y,z", "Where the eye is", [&o](const std::string& s) {
        const auto [x, y, z] = parse_triple("--look-from", s);
        o.look_from = Point3{x, y, z};
    });
    option("--look-at", "x,y,z", "What is in the middle of the picture", [&o](const std::string& s) {
        const auto [x, y, z] = parse_triple("--look-at", s);
        o.look_at = Point3{x, y, z};
    });
    option("--vup", "x,y,z", "What is up in the picture", [&o](const std::string& s) {
        const auto [x, y, z] = parse_triple("--vup", s);
        o.up = Vec3{x, y, z};
        if (*o.up == Vec3{}) refuse("--vup", s, "must not be zero");
    });
    option("--vfov", "DEG", "Full angle between the top and the bottom of the picture", [&o](const std::string& s) {
        o.vertical_fov = parse_number("--vfov", s);
        if (!(*o.vertical_fov > 0 && *o.vertical_fov < 180))
            refuse("--vfov", s, "must be over 0 and under 180 degrees");
    });
    option("--aperture-angle", "DEG", "Full angle of the lens seen from the plane in focus; 0: all is sharp",
           [&o](const std::string& s) {
               o.aperture_angle = parse_number("--aperture-angle", s);
               if (!(*o.aperture_angle >= 0 && *o.aperture_angle < 180))
                   refuse("--aperture-angle", s, "must be at least 0 and under 180 degrees");
           });
    option("--focus-dist", "D", "Distance of the plane in focus", [&o](const std::string& s) {
        o.focus_distance = parse_number("--focus-dist", s);
        if (!(*o.focus_distance > 0)) refuse("--focus-dist", s, "must be positive");
    });
}

// Names that later versions will give a meaning to. Refused, so that no script comes to rely on their absence.
void add_reserved(CLI::App& app) {
    for (const char* name : {"--shard", "--checkpoint", "--resume"})
        add(app, name, "X", "",
            [name](const std::string& s) {
                refuse(name, s, "this option is reserved and not available in this version");
            })
            ->expected(0, 1)
            ->group("");
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

void add_render_options(CLI::App& app, RenderOptions& o) {
    app.add_option("-o,--output", o.outputs, "A picture to write, .exr or .png; may be repeated")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->each(picture_name("-o"));
    add_numbers(app, o);
    app.add_flag("--no-antialias", o.no_antialias, "Rays through the centres of pixels only");
    add(app, "--channels", "error,samples",
        "Channels that an EXR gets beside its colours: each pixel's estimated relMSE, how many samples it has",
        [&o](const std::string& s) { o.channels = parse_channels(s); });
    app.add_flag("--half", o.half, "EXR with 16 bits a value instead of 32");
    app.add_option("--report", o.report, "Write what was done and how well as JSON; - for standard output")
        ->type_name("FILE.json")
        ->each(file_name("--report"));
    app.add_flag("--quiet", o.quiet, "Say nothing but errors");
    add_camera(app, o.camera);
    add_reserved(app);
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
