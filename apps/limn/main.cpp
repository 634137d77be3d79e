#include <string>
#include <string_view>

#include "commands.h"
#include "limn/core/error.h"
#include "limn/render/render.h"
#include "program.h"
#include "text_file.h"

namespace limn::app {

namespace {

constexpr std::string_view kUsage =
    "usage: limn render MODEL.obj -o OUT.exr [options]    render a model\n"
    "       limn compare TEST REF [REF_B] [--json FILE]   the error between two images\n"
    "       limn info FILE [--json FILE]                  what a model or an image holds\n"
    "       limn trace MODEL.obj [options]                which face each ray hits: text or float64 in and out\n"
    "       limn bench [MODEL.obj ...] [options]          rays a second here, beside Embree where it is there\n"
    "       limn COMMAND --help                           the options of a command\n"
    "       limn --version\n";

constexpr std::string_view kReserved[] = {"merge"};

int dispatch(int argc, char** argv) {
    if (argc < 2) throw ArgumentError("a command is missing\n" + std::string(kUsage));
    const std::string command = argv[1];
    if (command == "render") return render_command(argc - 1, argv + 1);
    if (command == "compare") return compare_command(argc - 1, argv + 1);
    if (command == "info") return info_command(argc - 1, argv + 1);
    if (command == "trace") return trace_command(argc - 1, argv + 1);
    if (command == "bench") return bench_command(argc - 1, argv + 1);
    for (const std::string_view name : kReserved)
        if (command == name) throw ArgumentError(command + ": this command is not available in this version");
    if (argc > 2) throw ArgumentError("'" + command + "' is not a command\n" + std::string(kUsage));
    if (command == "--version") {
        write_text("-", "limn " + std::string(version()) + "\n");
    } else if (command == "--help" || command == "-h") {
        write_text("-", kUsage);
    } else {
        throw ArgumentError("'" + command + "' is not a command\n" + std::string(kUsage));
    }
    return kDone;
}

}  // namespace

}  // namespace limn::app

int main(int argc, char** argv) {
    return limn::app::run_program("limn", [&] { return limn::app::dispatch(argc, argv); });
}
