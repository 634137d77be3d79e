#include <filesystem>

#include "commands.h"
#include "limn/io/model.h"
#include "parse.h"
#include "render_task.h"
#include "text_file.h"
#include "viewing_scene.h"

namespace limn::app {

namespace {

// The default settings, and a camera that has the whole box in the picture.
Figure view_of_box(const Box& box, const RenderOptions& options) {
    Figure figure;
    const Size size = options.size.value_or(Size{figure.settings.width, figure.settings.height});
    figure.camera = frame_box(box, static_cast<double>(size.width) / size.height);
    return figure;
}

Figure view_of(const std::string& path, const RenderOptions& options, const Console& console) {
    const Model model = load_model(path);
    check_distinct(options.all_outputs(), model.files);
    for (const std::string& warning : model.warnings) console.note(warning);
    Figure figure = view_of_box(model.bounds(), options);
    figure.name = std::filesystem::path(path).filename().string();
    figure.scene = make_viewing_scene(model);
    return figure;
}

}  // namespace

int render_command(int argc, const char* const* argv) {
    Options command("limn render",
                    "Renders a model (OBJ, PLY, STL, glTF) under a default light. The camera stands at the front right "
                    "unless its options "
                    "say otherwise.");
    std::string model;
    RenderOptions options;
    options.command_line = "limn " + command_line(argc, argv);
    command.add({.name = "MODEL", .value = "", .help = "The model: OBJ, PLY, STL or glTF", .required = true},
                file_name("MODEL", model));
    add_render_options(command, options);
    state_presets(command, view_of_box({{-1, -1, -1}, {1, 1, 1}}, options));
    command.preset("--look-from", "the front right, from where all of the model is seen");
    command.preset("--look-at", "the middle of the model");
    if (!command.parse(argc, argv)) return kDone;
    check_together(options);

    const Console console{.program = "limn", .quiet = options.quiet};
    const RenderTask task{.make = [&] { return view_of(model, options, console); }, .inputs = {model}};
    return run_render_task(task, options, console);
}

}  // namespace limn::app
