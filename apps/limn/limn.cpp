#include <string>
#include <string_view>
#include <vector>

#include "commands.h"
#include "limn/math/error.h"
#include "limn/render/render.h"
#include "options.h"
#include "program.h"
#include "text_file.h"

namespace limn::app {

namespace {

// After a message, on lines of its own.
constexpr std::string_view kUsage =
    "\nusage: limn render MODEL -o OUT.exr [options]       render a model\n"
    "       limn merge FILM ... -o OUT.exr [options]     one picture from the films of its parts\n"
    "       limn compare TEST REF [REF_B] [options]      the error between two images\n"
    "       limn info FILE [--json FILE]                 what a model, a film or an image holds\n"
    "       limn trace MODEL [options]                   the face that each ray hits, as text or float64\n"
    "       limn bench [MODEL.obj ...] [options]         rays per second on this machine, beside Embree\n"
    "       limn help COMMAND                            the options of a command; or limn COMMAND --help\n"
    "       limn --version";

struct Command {
    std::string name;
    int (*run)(int argc, const char* const* argv);
};
const std::vector<Command> kCommands{{"render", render_command}, {"merge", merge_command}, {"compare", compare_command},
                                     {"info", info_command},     {"trace", trace_command}, {"bench", bench_command}};

const Command& find_command(const std::string& name) {
    for (const Command& command : kCommands)
        if (command.name == name) return command;
    std::vector<std::string> words{"help", "--help", "--version"};
    for (const Command& command : kCommands) words.push_back(command.name);
    throw ArgumentError("'" + name + "' is not a command" + did_you_mean(name, words) + std::string(kUsage));
}

int help_command(int argc, const char* const* argv) {
    if (argc > 2) throw ArgumentError("help: takes the name of one command");
    const std::string_view name = argc == 2 ? argv[1] : "help";
    if (name != "help" && !name.starts_with('-')) {
        const char* const words[] = {argv[1], "--help"};
        return find_command(argv[1]).run(2, words);
    }
    write_text("-", std::string(kUsage.substr(1)) + "\n");
    return kDone;
}

int dispatch(int argc, const char* const* argv) {
    if (argc < 2) throw ArgumentError("a command is missing" + std::string(kUsage));
    const std::string name = argv[1];
    if (name == "help") return help_command(argc - 1, argv + 1);
    if (argc > 2 && name.starts_with('-')) throw ArgumentError(name + ": a command comes first" + std::string(kUsage));
    if (name == "--help" || name == "-h") return help_command(1, argv);
    if (name == "--version") {
        write_text("-", "limn " + std::string(version()) + "\n");
        return kDone;
    }
    return find_command(name).run(argc - 1, argv + 1);
}

}  // namespace

int run_limn(int argc, const char* const* argv) noexcept {
    return run_program("limn", [&] { return dispatch(argc, argv); });
}

}  // namespace limn::app
