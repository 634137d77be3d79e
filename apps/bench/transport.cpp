// limn_transport SCENE [--describe | OPTION ...] renders a scene of ./build.sh convergence, with the options of the
// programs in examples/figures. With --describe it prints the scene as JSON for limn's peers.
#include "bench/transport_scenes.h"
#include "program.h"
#include "text_file.h"

int main(int argc, char** argv) {
    using namespace limn;
    const std::string scene = argc > 1 ? argv[1] : "";
    const bool describes = argc < 2 || (argc == 3 && std::string(argv[2]) == "--describe");
    const auto make = [&](const FigureInputs&) { return bench::make_transport_scene(scene); };
    if (!describes) return figure_main(argc - 1, argv + 1, scene, make);
    return app::run_program("limn_transport", [&] {
        app::write_text("-", app::json_text(bench::describe_scene(make({}))));
        return app::kDone;
    });
}
