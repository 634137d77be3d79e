#include <CLI/CLI.hpp>
#include <filesystem>

#include "commands.h"
#include "limn/io/obj.h"
#include "parse.h"
#include "render_job.h"
#include "text_file.h"
#include "viewing_scene.h"

namespace limn::app {

namespace {

Figure view_of(const std::string& path, const RenderOptions& options, const Console& console) {
    const Model model = load_obj(path);
    check_distinct(options.all_outputs(), model.files);
    for (const std::string& warning : model.warnings) console.note(warning);
    Figure figure{.name = std::filesystem::path(path).filename().string(),
                  .scene = make_viewing_scene(model),
                  .camera = {},
                  .settings = {}};
    const Size size = options.size.value_or(Size{figure.settings.width, figure.settings.height});
    figure.camera = frame_box(model.bounds(), static_cast<double>(size.width) / size.height);
    return figure;
}

}  // namespace

int render_command(int argc, const char* const* argv) {
    CLI::App cli(
        "Renders a Wavefront OBJ under a default light, from the front right unless the camera options say "
        "otherwise.",
        "limn render");
    std::string model;
    RenderOptions options;
    options.command_line = "limn " + command_line(argc, argv);
    cli.add_option("MODEL", model, "The model, a Wavefront OBJ")->required()->each(file_name("MODEL"));
    add_render_options(cli, options);
    cli.get_option("--output")->required();
    if (!parse_arguments(cli, argc, argv)) return kDone;

    const Console console{.program = "limn", .quiet = options.quiet};
    const RenderJob job{.make = [&] { return view_of(model, options, console); }, .inputs = {model}};
    return run_render_job(job, options, console);
}

}  // namespace limn::app
