#include <CLI/CLI.hpp>

#include "figure.h"
#include "program.h"
#include "render_job.h"
#include "render_options.h"

namespace limn {

namespace {

Encoding parse_encoding(const std::string& text) {
    if (text == "auto") return Encoding::automatic;
    if (text == "srgb") return Encoding::srgb;
    if (text == "raw") return Encoding::raw;
    app::refuse("--texture-encoding", text, "must be auto, srgb or raw");
}

void add_texture_options(CLI::App& app, FigureInputs& inputs) {
    app.add_option("--texture", inputs.texture, "The picture to use")
        ->type_name("FILE")
        ->capture_default_str()
        ->each(app::file_name("--texture"));
    app.add_option_function<std::string>(
           "--texture-encoding", [&inputs](const std::string& text) { inputs.texture_encoding = parse_encoding(text); },
           "How its values become linear: auto goes by the file, raw takes them as they are")
        ->type_name("auto|srgb|raw");
}

}  // namespace

int figure_main(int argc, char** argv, std::string_view name, const std::function<Figure(const FigureInputs&)>& make,
                const std::optional<FigureInputs>& defaults) {
    const std::string program(name);
    return app::run_program(program, [&] {
        CLI::App cli("Renders " + program + ".exr and " + program + ".png, or what -o names.", program);
        app::RenderOptions options;
        options.command_line = app::command_line(argc, argv);
        app::add_render_options(cli, options);
        FigureInputs inputs = defaults.value_or(FigureInputs{});
        if (defaults) add_texture_options(cli, inputs);
        if (!app::parse_arguments(cli, argc, argv)) return app::kDone;
        if (options.outputs.empty()) options.outputs = {program + ".exr", program + ".png"};

        const app::RenderJob job{.make = [&] { return make(inputs); }, .inputs = {inputs.texture}};
        return app::run_render_job(job, options, {.program = program, .quiet = options.quiet});
    });
}

}  // namespace limn
