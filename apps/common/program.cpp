#include "program.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "text_file.h"

namespace limn::app {

void Console::note(const std::string& message) const {
    if (!quiet) error(message);
}

void Console::error(const std::string& message) const {
    std::fprintf(stderr, "%s: %s\n", program.c_str(), message.c_str());
}

bool parse_arguments(CLI::App& app, int argc, const char* const* argv) {
    try {
        app.parse(argc, argv);
        return true;
    } catch (const CLI::CallForHelp&) {
        write_text("-", app.help());
        return false;
    } catch (const CLI::ParseError& e) {
        throw ArgumentError(std::string(e.what()) + " (see " + app.get_name() + " --help)");
    }
}

int run_program(const std::string& program, const std::function<int()>& body) noexcept {
    // Writing to a pipe that nobody reads becomes an error of that write.
    std::signal(SIGPIPE, SIG_IGN);
    const Console console{.program = program};
    try {
        return body();
    } catch (const ArgumentError& e) {
        console.error(e.what());
        return kBadArguments;
    } catch (const std::bad_alloc&) {
        console.error("out of memory");
    } catch (const std::exception& e) {
        console.error(e.what());
    } catch (...) {
        console.error("an unknown failure");
    }
    return kFailed;
}

}  // namespace limn::app
