#include "render_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "limn/math/error.h"

namespace limn::app {

namespace {

constexpr int kMostSamples = std::numeric_limits<int>::max();
constexpr int kMostThreads = 1024;

constexpr std::pair<const char*, Projection> kProjections[] = {{"perspective", Projection::perspective},
                                                               {"orthographic", Projection::orthographic},
                                                               {"panorama", Projection::panorama}};

// The default in --help until state_presets replaces it by that of a figure.
constexpr const char* kOfScene = "the scene's own";

// Adds the options with the figure's RenderSettings.
void add_numbers(Options& options, RenderOptions& o) {
    // Add the pixels to render.
    options.add({.name = "--size", .value = "WxH", .help = "Size of the picture in pixels", .preset = kOfScene},
                [&o](const std::string& s) { o.size = parse_size("--size", s); });
    options.add({.name = "--crop",
                 .value = "X0,Y0,X1,Y1",
                 .help = "Render these pixels alone, counted from the top left corner: columns X0 to X1 - 1 of rows Y0 "
                         "to Y1 - 1",
                 .preset = "all"},
                [&o](const std::string& s) { o.crop = parse_bounds("--crop", s); });
    // Add what ends the render.
    options.add({.name = "--spp",
                 .value = "N",
                 .help = "Samples per pixel; with --error or --time-limit the upper limit of their average",
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
                 .help = "Stop rendering after that time; with --error, whichever comes first. --spp is then the upper "
                         "limit",
                 .preset = "none"},
                [&o](const std::string& s) { o.time_limit = parse_positive("--time-limit", s); });
    options.add_flag("--uniform", o.uniform,
                     "Take the same number of samples in every pixel (with --error or --time-limit)");
    // Add how it is rendered.
    options.add({.name = "--seed",
                 .value = "N",
                 .help = "Seed of the random numbers: the same seed gives the same picture",
                 .preset = kOfScene},
                [&o](const std::string& s) {
                    o.seed = parse_integer<std::uint64_t>("--seed", s, 0, std::numeric_limits<std::uint64_t>::max());
                });
    options.add({.name = "--threads",
                 .value = "N",
                 .help = "Number of threads; the picture does not depend on it",
                 .preset = "one for each processor"},
                [&o](const std::string& s) { o.threads = parse_integer("--threads", s, 1, kMostThreads); });
    options.add({.name = "--max-depth",
                 .value = "N|unlimited",
                 .help = "Largest number of ray segments in a path",
                 .preset = kOfScene},
                [&o](const std::string& s) {
                    o.max_depth =
                        s == "unlimited" ? kUnlimitedDepth : parse_integer("--max-depth", s, 1, kUnlimitedDepth - 1);
                });
    options.add({.name = "--estimator",
                 .value = "path|naive",
                 .help = "path samples lamps and scattering, naive scattering alone",
                 .preset = kOfScene},
                [&o](const std::string& s) {
                    if (s != "path" && s != "naive") refuse("--estimator", s, "must be path or naive");
                    o.estimator = s == "path" ? Estimator::path : Estimator::naive;
                });
    options.add({.name = "--sampler",
                 .value = "sobol|independent",
                 .help = "sobol spreads the samples of a pixel evenly, independent does not",
                 .preset = kOfScene},
                [&o](const std::string& s) {
                    if (s != "sobol" && s != "independent") refuse("--sampler", s, "must be sobol or independent");
                    o.sampler = s == "sobol" ? SamplerKind::sobol : SamplerKind::independent;
                });
}

Shard parse_shard(const std::string& text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos) refuse("--shard", text, "is not of the form I/N");
    const int count = parse_integer("--shard", std::string_view(text).substr(slash + 1), 1, 1 << 24);
    return {.index = parse_integer("--shard", std::string_view(text).substr(0, slash), 1, count), .count = count};
}

// Adds the options of long renders.
void add_films(Options& options, RenderOptions& o) {
    const auto add = [&options](const char* name, const char* value, const char* help, const char* preset,
                                const Use& use) {
        options.add({.name = name, .value = value, .help = help, .preset = preset, .group = "Long renders"}, use);
    };
    add("--checkpoint", "FILE", "Save the film at regular intervals and at the end", "none",
        file_name("--checkpoint", o.checkpoint));
    add("--every", "SECONDS", "Time between two checkpoints", "60",
        [&o](const std::string& s) { o.every = parse_positive("--every", s); });
    add("--preview", "SECONDS", "Write the pictures of -o also during the render, at this interval", "none",
        [&o](const std::string& s) { o.preview = parse_positive("--preview", s); });
    add("--resume", "FILE",
        "Continue the render of this film. Threads, outputs, --spp, --error and --time-limit may differ. If the film "
        "is also written, it need not exist yet",
        "none", file_name("--resume", o.resume));
    add("--shard", "I/N", "Render part I of N, with --film or --checkpoint; limn merge joins the parts", "1/1",
        [&o](const std::string& s) { o.shard = parse_shard(s); });
    add("--plan", "FILE", "Take as many samples as this plan of limn merge --plan asks for", "none",
        file_name("--plan", o.plan));
}

Projection parse_projection(const std::string& text) {
    for (const auto& [name, projection] : kProjections)
        if (text == name) return projection;
    refuse("--projection", text, "must be perspective, orthographic or panorama");
}

void add_camera(Options& options, CameraOptions& o) {
    const auto add = [&options](const char* name, const char* value, const char* help, const Use& use) {
        options.add({.name = name, .value = value, .help = help, .preset = kOfScene, .group = "Camera"}, use);
    };
    // Add the position and direction.
    add("--look-from", "x,y,z", "Position of the eye", [&o](const std::string& s) {
        const auto [x, y, z] = parse_triple("--look-from", s);
        o.look_from = Point3{x, y, z};
    });
    add("--look-at", "x,y,z", "Point in the middle of the picture", [&o](const std::string& s) {
        const auto [x, y, z] = parse_triple("--look-at", s);
        o.look_at = Point3{x, y, z};
    });
    add("--vup", "x,y,z", "Direction that is up in the picture", [&o](const std::string& s) {
        const auto [x, y, z] = parse_triple("--vup", s);
        o.up = Vec3{x, y, z};
        if (*o.up == Vec3{}) refuse("--vup", s, "must not be zero");
    });
    // Add the projection.
    add("--vfov", "DEG", "Vertical field of view, from the bottom to the top of the picture",
        [&o](const std::string& s) {
            o.vertical_fov = parse_number("--vfov", s);
            if (!(*o.vertical_fov > 0 && *o.vertical_fov < 180))
                refuse("--vfov", s, "must be over 0 and under 180 degrees");
        });
    add("--projection", "perspective|orthographic|panorama",
        "How the scene is seen: an orthographic view has a --height, a panorama shows all directions",
        [&o](const std::string& s) { o.projection = parse_projection(s); });
    add("--height", "H", "Height of an orthographic view in world units",
        [&o](const std::string& s) { o.view_height = parse_positive("--height", s); });
    // Add the lens.
    add("--aperture-angle", "DEG", "Full angle of the lens, seen from the plane in focus; 0 makes everything sharp",
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
    replace(camera.projection, o.projection);
    replace(camera.view_height, o.view_height);
}

void check_crop(const PixelBounds& c, const RenderSettings& settings) {
    if (c.right > settings.width || c.bottom > settings.height)
        throw ArgumentError(fmt::format("--crop {},{},{},{}: reaches beyond the picture of {}x{}", c.left, c.top,
                                        c.right, c.bottom, settings.width, settings.height));
}

}  // namespace

void add_render_options(Options& options, RenderOptions& o, const std::string& outputs) {
    add_picture_options(options, o, true, outputs);
    add_numbers(options, o);
    options.add_flag("--no-antialias", o.no_antialias, "Trace all camera rays through the centres of the pixels");
    add_films(options, o);
    add_camera(options, o.camera);
}

void check_together(RenderOptions& o, const std::vector<std::string>& outputs) {
    const auto require = [](bool holds, const char* what) {
        if (!holds) throw ArgumentError(what);
    };
    const bool is_part = o.shard && o.shard->count > 1;
    require(!o.every || !o.checkpoint.empty(), "--every: there is no --checkpoint");
    require(!o.preview || !o.outputs.empty() || !outputs.empty(), "--preview: there is no -o");
    require(!is_part || !o.film.empty() || !o.checkpoint.empty(),
            "--shard: needs --film or --checkpoint: a part is stored as a film, not as a picture");
    require(!is_part || o.outputs.empty(), "--shard: a part of a picture cannot be written by -o; see limn merge");
    require(!is_part || (!o.error && !o.time_limit),
            "--shard: excludes --error and --time-limit; limn merge has --error for all parts");
    require(o.plan.empty() || (!o.error && !o.time_limit && !o.samples_per_pixel),
            "--plan: sets the numbers of samples, and excludes --spp, --error and --time-limit");
    if (is_part) return;
    if (o.outputs.empty() && o.film.empty()) o.outputs = outputs;
    require(!o.outputs.empty() || !o.film.empty() || !o.checkpoint.empty(), "-o is missing: nothing would be written");
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
    options.preset("--projection", kProjections[static_cast<int>(c.projection)].first);
    options.preset("--height", c.view_height ? fmt::format("{}", *c.view_height) : "as much as --vfov shows");
    options.preset("--aperture-angle", fmt::format("{}", c.aperture_angle));
    options.preset("--focus-dist", c.focus_distance ? fmt::format("{}", *c.focus_distance) : "that of --look-at");
}

void apply(const RenderOptions& o, Figure& figure) {
    // Replace the settings. A new size determines the aspect ratio.
    RenderSettings& settings = figure.settings;
    if (o.size) {
        settings.width = o.size->width;
        settings.height = o.size->height;
        figure.camera.aspect_ratio.reset();
    }
    replace(settings.samples_per_pixel, o.samples_per_pixel);
    replace(settings.max_samples_per_pixel, o.samples_per_pixel);
    if (o.error) settings.error = o.error;
    if (o.time_limit) settings.time_limit = o.time_limit;
    if (o.uniform) settings.uniform = true;
    replace(settings.shard, o.shard);
    if (o.crop) check_crop(*o.crop, settings);
    if (o.crop) settings.crop = o.crop;
    replace(settings.seed, o.seed);
    replace(settings.threads, o.threads);
    replace(settings.max_depth, o.max_depth);
    replace(settings.estimator, o.estimator);
    replace(settings.sampler, o.sampler);
    if (o.no_antialias) settings.antialias = false;
    // Replace the camera, and check that the options belong to its projection.
    replace_camera(figure.camera, o.camera);
    const auto require = [](bool holds, const char* what) {
        if (!holds) throw ArgumentError(what);
    };
    require(!o.camera.view_height || figure.camera.projection == Projection::orthographic,
            "--height: needs --projection orthographic");
    require(!o.camera.vertical_fov || figure.camera.projection == Projection::perspective,
            "--vfov: needs --projection perspective");
}

void check_camera_alone(const CameraOptions& o) {
    if (!o.look_from || !o.look_at) return;
    if (!o.up && *o.look_from != *o.look_at) return;
    Camera camera;
    replace_camera(camera, o);
    CameraRays(camera, 1, 1);
}

}  // namespace limn::app
