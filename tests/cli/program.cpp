// How a program ends: what becomes of what its body throws.
#include "program.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <new>

#include "catch.h"
#include "limn/math/error.h"
#include "stderr.h"
#include "text_file.h"

namespace limn::test::program_test {
namespace {

template <class Body>
std::pair<int, std::string> end_of(const Body& body) {
    int status = -1;
    const std::string message = written_to_stderr([&] { status = app::run_program("prog", body); });
    return {status, message};
}

TEST_CASE("Program: faults of the arguments end with 2, all others with 1, each with its message", "[cli]") {
    using End = std::pair<int, std::string>;
    CHECK(end_of([] { return 0; }) == End{0, ""});
    CHECK(end_of([] { return 130; }) == End{130, ""});
    CHECK(end_of([]() -> int { throw ArgumentError("no such option"); }) == End{2, "prog: no such option\n"});
    CHECK(end_of([]() -> int { throw Error("broken"); }) == End{1, "prog: broken\n"});
    CHECK(end_of([]() -> int { throw std::runtime_error("odd"); }) == End{1, "prog: odd\n"});
    CHECK(end_of([]() -> int { throw std::bad_alloc(); }) == End{1, "prog: out of memory\n"});
    CHECK(end_of([]() -> int { throw 42; }) == End{1, "prog: an unknown failure\n"});
}

TEST_CASE("Program: notes are left out where it is quiet, errors are not", "[cli]") {
    const auto speak = [](bool quiet) {
        return written_to_stderr([&] {
            const app::Console console{.program = "prog", .quiet = quiet};
            console.note("by the way");
            console.error("alas");
        });
    };
    CHECK(speak(false) == "prog: by the way\nprog: alas\n");
    CHECK(speak(true) == "prog: alas\n");
}

TEST_CASE("Program: a reader that has gone is an error of writing, not the program's death", "[cli]") {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    close(ends[0]);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        std::signal(SIGPIPE, SIG_DFL);
        dup2(ends[1], STDOUT_FILENO);
        close(STDERR_FILENO);
        _exit(app::run_program("prog", [] {
            app::write_text("-", "text");
            return 0;
        }));
    }
    close(ends[1]);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 1);
}

}  // namespace
}  // namespace limn::test::program_test
