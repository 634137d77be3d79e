#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "commands.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "limn/scene/model_view.h"
#include "model_input.h"
#include "parse.h"
#include "render_task.h"
#include "text_file.h"

namespace limn::app {

namespace {

struct Arguments : RenderOptions {
    std::string model, camera_name, environment;
    std::optional<Color> background;
    bool no_background = false, no_ground = false;
    std::optional<double> crease;  // in degrees: ModelOptions::crease
};

// Returns a figure without scene, with the settings that hold without options.
Figure default_figure() {
    Figure figure;
    figure.camera.vertical_fov = 30;
    figure.settings.samples_per_pixel = 8;  // the fewest for which the error is estimated
    return figure;
}

// Sets the figure's camera to the one of the model that --camera names. If that camera has an aspect ratio and --size
// is not given, the picture gets this aspect ratio and keeps its height. \throws FileError if there is no such camera
void take_camera(const Model& model, const Arguments& a, Figure& figure) {
    const auto found = std::ranges::find(model.cameras, a.camera_name, &ModelCamera::name);
    if (found == model.cameras.end()) {
        std::vector<std::string> names;
        for (const ModelCamera& camera : model.cameras) names.push_back(camera.name);
        const std::string all = names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
        throw FileError(a.model, on_one_line(fmt::format("has no camera '{}'; it has {}", a.camera_name, all)));
    }
    figure.camera = found->camera;
    if (!figure.camera.aspect_ratio || a.size) return;
    const double width = std::round(figure.settings.height * *figure.camera.aspect_ratio);
    if (!(width <= kLongestSide))
        throw FileError(a.model, on_one_line(fmt::format("camera '{}' is {:g} times as wide as high: --size is needed",
                                                         a.camera_name, *figure.camera.aspect_ratio)));
    figure.settings.width = static_cast<int>(std::max(width, 1.0));
}

// Returns step(), which uses the content of the file at `path`. An ArgumentError becomes a FileError that names the
// file.
template <class Step>
auto from_file(const std::string& path, const Step& step) {
    try {
        return step();
    } catch (const ArgumentError& e) {
        throw FileError(path, e.what());
    }
}

std::shared_ptr<const EnvironmentMap> load_environment(const std::string& path) {
    Image image = load_image(path);
    return from_file(path, [&] { return std::make_shared<EnvironmentMap>(std::move(image)); });
}

// Returns the figure of a model: its scene, camera and settings before the options of RenderOptions are applied.
Figure view_of(const Arguments& a, const Model& model) {
    Figure figure = default_figure();
    const Size size = a.size.value_or(Size{figure.settings.width, figure.settings.height});
    ViewOptions view{.aspect_ratio = static_cast<double>(size.width) / size.height,
                     .background = a.background,
                     .ground = !a.no_ground};
    if (a.camera.projection) view.projection = *a.camera.projection;
    if (a.camera.up) view.up = *a.camera.up;
    if (!a.environment.empty()) view.environment = load_environment(a.environment);
    ModelView seen = from_file(a.model, [&] { return view_model(model, view); });
    figure.scene = std::move(seen.scene);
    figure.camera = seen.camera;
    figure.name = std::filesystem::path(a.model).filename().string();
    figure.settings.transparent = a.no_background;
    if (!a.camera_name.empty()) take_camera(model, a, figure);
    return figure;
}

// Reads the model and returns its figure. Prints the model's warnings.
Figure read_figure(const Arguments& a, const Console& console) {
    const Model model = from_files([&] { return read_model(a.model, {.crease = a.crease}); });
    check_distinct(a.all_outputs(), model.files);
    for (const std::string& warning : model.warnings) console.note(warning);
    return from_files([&] { return view_of(a, model); });
}

void add_view_options(Options& command, Arguments& a) {
    const auto add = [&command](const char* name, const char* value, const char* help, const char* preset,
                                const Use& use) {
        command.add({.name = name, .value = value, .help = help, .preset = preset, .group = "View"}, use);
    };
    // Add the light.
    add("--background", "R,G,B|none",
        "Colour of the background, which also lights the model; none: the sky lights it, but is transparent in the "
        "picture",
        "a sky", [&a](const std::string& text) {
            a.no_background = text == "none";
            if (a.no_background) return;
            const auto [r, g, b] = parse_triple("--background", text);
            if (!(r >= 0 && g >= 0 && b >= 0)) refuse("--background", text, "must not be negative");
            a.background = Color{r, g, b};
        });
    add("--environment", "FILE",
        "Light the model by an environment map, an equirectangular picture, in place of the key light and the sky",
        "none", file_name("--environment", a.environment));
    // Add the ground, the shading and the camera.
    add("--ground", "none", "Leave out the ground under the model", "a ground", [&a](const std::string& text) {
        if (text != "none") refuse("--ground", text, "must be none");
        a.no_ground = true;
    });
    add("--smooth", "DEG",
        "Shade meshes without normals smoothly across edges at which the triangles turn by less than DEG",
        "flat shading", [&a](const std::string& text) {
            a.crease = parse_number("--smooth", text);
            if (!(*a.crease >= 0 && *a.crease <= 180)) refuse("--smooth", text, "must be in 0 .. 180 degrees");
        });
    add("--camera", "NAME", "A camera of the model file; limn info names them", "one that frames the model",
        [&a](const std::string& text) {
            if (text.empty()) refuse("--camera", "''", "is not the name of a camera");
            a.camera_name = text;
        });
}

}  // namespace

int render_command(int argc, const char* const* argv) {
    // Read the options.
    Options command("limn render",
                    "Renders a model (OBJ, PLY, STL, glTF) on a ground, under a key light and a sky. The camera stands "
                    "at the front right unless its options say otherwise.");
    Arguments a;
    a.command_line = "limn " + command_line(argc, argv);
    command.add({.name = "MODEL",
                 .value = "",
                 .help = "The model: OBJ, PLY, STL or glTF; - for standard input",
                 .required = true},
                file_name("MODEL", a.model));
    add_render_options(command, a);
    add_view_options(command, a);
    state_presets(command, default_figure());
    command.preset("--look-from", "the front right, from where all of the model is seen");
    command.preset("--look-at", "the point on the view axis nearest to the middle of the model");
    command.preset("--height", "as high as the model");
    if (!command.parse(argc, argv)) return kDone;
    check_together(a);
    if (a.background && !a.environment.empty())
        throw ArgumentError("--environment: is the background, and so is --background");

    // Render.
    const Console console{.program = "limn", .quiet = a.quiet};
    const RenderTask task{.make = [&] { return read_figure(a, console); },
                          .inputs = {input_file(a.model), a.environment}};
    return run_render_task(task, a, console);
}

}  // namespace limn::app
