// One scene of the convergence report, rendered by limn or described for its peers. Run by convergence.py.
#include <algorithm>

#include "bench/describe_scene.h"
#include "bench/transport_scenes.h"
#include "parse.h"
#include "program.h"
#include "render_options.h"
#include "render_task.h"
#include "text_file.h"

namespace {

using namespace limn;

std::string list_of_scenes() {
    std::string list;
    for (const std::string& name : bench::transport_scene_names()) list += (list.empty() ? "" : ", ") + name;
    return list;
}

int transport_main(int argc, char** argv) {
    app::Options command("limn_transport",
                         "Renders a scene of the convergence report, or describes it: " + list_of_scenes() + ".");
    std::string scene, description;
    app::RenderOptions options;
    options.command_line = app::command_line(argc, argv);
    command.add({.name = "SCENE", .value = "", .help = "Which", .required = true}, [&scene](const std::string& name) {
        const std::vector<std::string> known = bench::transport_scene_names();
        if (std::find(known.begin(), known.end(), name) == known.end())
            app::refuse("SCENE", name, "must be one of " + list_of_scenes());
        scene = name;
    });
    command.add({.name = "--describe",
                 .value = "FILE",
                 .help = "Write it as JSON, - for standard output, and stop",
                 .preset = "it is rendered"},
                app::file_name("--describe", description));
    app::add_render_options(command, options, "SCENE.exr");
    if (!command.parse(argc, argv)) return app::kDone;

    if (!description.empty()) {
        app::check_text_path(description);
        const Figure figure = app::from_files([&] { return bench::make_transport_scene(scene); });
        app::write_text(description, app::json_text(bench::describe_scene(figure)));
        return app::kDone;
    }
    app::check_together(options, {scene + ".exr"});
    const app::RenderTask task{.make = [&] { return bench::make_transport_scene(scene); }, .inputs = {}};
    return app::run_render_task(task, options, {.program = "limn_transport", .quiet = options.quiet});
}

}  // namespace

int main(int argc, char** argv) {
    return limn::app::run_program("limn_transport", [&] { return transport_main(argc, argv); });
}
