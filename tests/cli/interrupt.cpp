// SIGINT and SIGTERM, and the progress bar that tells when a render is under way.
#include "interrupt.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <map>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "house.h"
#include "limn/io/image_io.h"
#include "process.h"
#include "support/folder.h"

namespace limn::test::interrupt_test {
namespace {

constexpr const char* kEndless = "1000000000";

void check_partial_picture(int signal, int status) {
    const Folder folder;
    const std::string model = folder.write("house.obj", house_obj());
    OnTerminal program(LIMN_PROGRAM, {"render", model, "-o", folder.path("a.exr"), "--size", "16x12", "--spp", kEndless,
                                      "--report", folder.path("r.json")});
    REQUIRE(program.wait_for(" %"));  // the bar: rendering has begun
    REQUIRE(program.wait_for(" %"));  // drawn anew: a part of the picture is done
    program.send(signal);
    const Outcome outcome = program.finish();
    CHECK(outcome.status == status);
    CHECK(outcome.err.find("limn: interrupted; " + folder.path("a.exr")) != std::string::npos);
    CHECK(folder.names() == Names{"a.exr", "house.obj", "r.json"});

    const Image image = load_image(folder.path("a.exr"));
    CHECK(image.width() == 16);
    CHECK(image.height() == 12);
    std::map<std::string, std::string> facts;
    for (const auto& [name, value] : load_image_facts(folder.path("a.exr"))) facts[name] = value;
    CHECK(facts["complete"] == "no");
    CHECK(std::stod(facts["spp"]) > 0);
    CHECK(std::stod(facts["spp"]) < 1e9);
    CHECK(nlohmann::json::parse(folder.read("r.json"))["spp"] > 0);
}

TEST_CASE("Interruption: SIGINT saves the partial picture and ends with 130", "[cli]") {
    check_partial_picture(SIGINT, 130);
}

TEST_CASE("Interruption: SIGTERM saves the partial picture and ends with 143", "[cli]") {
    check_partial_picture(SIGTERM, 143);
}

TEST_CASE("Interruption: a picture that cannot be saved any more costs neither the others nor the report", "[cli]") {
    const Folder folder;
    std::filesystem::create_directory(folder.path("gone"));
    OnTerminal program(LIMN_PROGRAM,
                       {"render", folder.write("house.obj", house_obj()), "-o", folder.path("gone/a.exr"), "-o",
                        folder.path("b.png"), "--size", "16x12", "--spp", kEndless, "--report", folder.path("r.json")});
    REQUIRE(program.wait_for(" %"));
    REQUIRE(program.wait_for(" %"));
    std::filesystem::remove(folder.path("gone"));
    program.send(SIGINT);
    const Outcome outcome = program.finish();
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("gone/a.exr") != std::string::npos);
    CHECK(outcome.err.find("samples a pixel") == std::string::npos);  // what was not done is not reported as done
    CHECK(folder.names() == Names{"b.png", "house.obj", "r.json"});
}

TEST_CASE("Interruption: the first signal is remembered, the second one ends the program", "[cli]") {
    for (const int second : {SIGINT, SIGTERM}) {
        const pid_t child = fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            signal(SIGINT, SIG_IGN);  // as a shell starts its background jobs
            app::catch_interrupts();
            raise(SIGINT);
            if (app::caught_signal() == SIGINT) raise(second);
            _exit(1);
        }
        int status = 0;
        REQUIRE(waitpid(child, &status, 0) == child);
        REQUIRE(WIFSIGNALED(status));
        CHECK(WTERMSIG(status) == second);
    }
}

TEST_CASE("Progress: a bar is drawn on a terminal and taken away at the end, and not with --quiet", "[cli]") {
    const Folder folder;
    const std::string model = folder.write("house.obj", house_obj());
    const auto terminal = [&](const Words& more) {
        Words words = {"render", model, "-o", folder.path("a.exr"), "--size", "64x64", "--spp", "64"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = OnTerminal(LIMN_PROGRAM, words).finish();
        CHECK(outcome.status == 0);
        return outcome.err;
    };
    const std::string drawn = terminal({});
    const std::size_t bar = drawn.find(" %"), erased = drawn.rfind("\r\033[K");
    REQUIRE(bar != std::string::npos);
    REQUIRE(erased != std::string::npos);
    CHECK(bar < erased);
    CHECK(drawn.find(" %", erased) == std::string::npos);
    CHECK(terminal({"--quiet"}).empty());
}

}  // namespace
}  // namespace limn::test::interrupt_test
