#include "program.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

namespace limn::app {

void Console::note(const std::string& message) const {
    if (!quiet) error(message);
}

void Console::error(const std::string& message) const {
    std::fprintf(stderr, "%s: %s\n", program.c_str(), message.c_str());
}

int run_program(const std::string& program, const std::function<int()>& body) noexcept {
    // Ignore SIGPIPE, so that writing to a pipe without a reader fails with an error instead of ending the program.
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
