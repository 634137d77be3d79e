// Renders a scene of ./build.sh convergence as the programs of the figures do. With --describe it prints the scene as
// JSON for limn's peers.
#include <algorithm>
#include <iostream>

#include "bench/transport_scenes.h"
#include "json_output.h"
#include "program.h"
#include "text_file.h"

int main(int argc, char** argv) {
    using namespace limn;
    const std::vector<std::string> names = bench::transport_scene_names();
    const std::string scene = argc > 1 ? argv[1] : "";
    if (std::ranges::find(names, scene) == names.end()) {
        std::cerr << "usage: limn_transport SCENE [--describe | OPTION ...]\nscenes:";
        for (const std::string& name : names) std::cerr << ' ' << name;
        std::cerr << '\n';
        return 2;
    }
    const auto make = [&](const FigureInputs&) { return bench::make_transport_scene(scene); };
    if (argc != 3 || std::string(argv[2]) != "--describe") return figure_main(argc - 1, argv + 1, scene, make);
    return app::run_program("limn_transport", [&] {
        app::write_text("-", app::json_text(bench::describe_scene(make({}))));
        return app::kDone;
    });
}
