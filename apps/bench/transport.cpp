// One scene of the convergence report, rendered by limn or described for its peers. Run by convergence.py.
#include <CLI/CLI.hpp>

#include "bench/describe_scene.h"
#include "bench/transport_scenes.h"
#include "parse.h"
#include "program.h"
#include "render_job.h"
#include "render_options.h"
#include "text_file.h"

namespace {

using namespace limn;

std::string list_of_scenes() {
    std::string list;
    for (const std::string& name : bench::transport_scene_names()) list += (list.empty() ? "" : ", ") + name;
    return list;
}

void check_scene(const std::string& name) {
    for (const std::string& known : bench::transport_scene_names())
        if (name == known) return;
    app::refuse("SCENE", name, "must be one of " + list_of_scenes());
}

int transport_main(int argc, char** argv) {
    CLI::App cli("Renders a scene of the convergence report, or describes it: " + list_of_scenes() + ".",
                 "limn_transport");
    std::string scene, description;
    app::RenderOptions options;
    options.command_line = app::command_line(argc, argv);
    cli.add_option("SCENE", scene, "Which")->required()->each(check_scene);
    auto* describe = cli.add_option("--describe", description, "Write it as JSON, - for standard output, and stop")
                         ->type_name("FILE")
                         ->each(app::file_name("--describe"));
    app::add_render_options(cli, options);
    if (!app::parse_arguments(cli, argc, argv)) return app::kDone;

    if (*describe) {
        app::check_text_path(description);
        const Figure figure = app::from_files([&] { return bench::make_transport_scene(scene); });
        app::write_text(description, app::json_text(bench::describe_scene(figure)));
        return app::kDone;
    }
    if (options.outputs.empty()) options.outputs = {scene + ".exr"};
    const app::RenderJob job{.make = [&] { return bench::make_transport_scene(scene); }, .inputs = {}};
    return app::run_render_job(job, options, {.program = "limn_transport", .quiet = options.quiet});
}

}  // namespace

int main(int argc, char** argv) {
    return limn::app::run_program("limn_transport", [&] { return transport_main(argc, argv); });
}
