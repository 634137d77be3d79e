#include "figure.h"
#include "limn/math/error.h"
#include "options.h"
#include "parse.h"
#include "program.h"
#include "render_options.h"
#include "render_task.h"

namespace limn {

namespace {

Encoding parse_encoding(const std::string& text) {
    if (text == "auto") return Encoding::automatic;
    if (text == "srgb") return Encoding::srgb;
    if (text == "raw") return Encoding::raw;
    app::refuse("--texture-encoding", text, "must be auto, srgb or raw");
}

const char* name_of(Encoding encoding) {
    switch (encoding) {
        case Encoding::automatic: break;
        case Encoding::srgb: return "srgb";
        case Encoding::raw: return "raw";
    }
    return "auto";
}

void add_texture_options(app::Options& options, FigureInputs& inputs) {
    options.add({.name = "--texture",
                 .value = "FILE",
                 .help = "The picture to use as texture",
                 .preset = inputs.texture.empty() ? "none" : inputs.texture},
                app::file_name("--texture", inputs.texture));
    options.add({.name = "--texture-encoding",
                 .value = "auto|srgb|raw",
                 .help = "How its values are converted to linear ones: auto, as the file says; srgb; raw, not at all",
                 .preset = name_of(inputs.texture_encoding)},
                [&inputs](const std::string& text) { inputs.texture_encoding = parse_encoding(text); });
}

}  // namespace

int figure_main(int argc, char** argv, std::string_view name, const std::function<Figure(const FigureInputs&)>& make,
                const std::optional<FigureInputs>& defaults) {
    const std::string program(name);
    return app::run_program(program, [&] {
        // Describe the options.
        const std::string exr = program + ".exr", png = program + ".png";
        app::Options command(program, "Renders the figure.");
        app::RenderOptions options;
        options.command_line = app::command_line(argc, argv);
        app::add_render_options(command, options, exr + " and " + png);
        FigureInputs inputs = defaults.value_or(FigureInputs{});
        if (defaults) add_texture_options(command, inputs);
        const auto state = [&] {
            try {
                app::state_presets(command, make(defaults.value_or(FigureInputs{})));
            } catch (const Error&) {  // a file is missing; --help then says "the scene's own" in place of values
            }
        };
        // Parse the command line and render.
        if (!command.parse(argc, argv, state)) return app::kDone;
        app::check_together(options, {exr, png});

        const app::RenderTask task{.make = [&] { return app::from_files([&] { return make(inputs); }); },
                                   .inputs = {inputs.texture}};
        return app::run_render_task(task, options, {.program = program, .quiet = options.quiet});
    });
}

}  // namespace limn
