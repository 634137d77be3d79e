// Programs on top of figure_main.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "limn/io/image_io.h"
#include "process.h"
#include "support/folder.h"

namespace limn::test::figure_program_test {
namespace {

TEST_CASE("Figure program: writes NAME.exr and NAME.png in the current folder, or what -o names", "[cli]") {
    const Folder folder;
    const Outcome plain = run(TINY_FIGURE_PROGRAM, {"--quiet"}, folder.path());
    REQUIRE(plain.status == 0);
    CHECK(plain.err.empty());
    CHECK(folder.names() == Names{"tiny.exr", "tiny.png"});
    const Image image = load_image(folder.path("tiny.exr"));
    CHECK(image.width() == 6);
    CHECK(image.height() == 4);
    CHECK(image.at(3, 2) == Color{1, 1, 1});
    const auto facts = load_image_facts(folder.path("tiny.exr"));
    const std::pair<std::string, std::string> command{"command_line", std::string(TINY_FIGURE_PROGRAM) + " --quiet"};
    CHECK(std::find(facts.begin(), facts.end(), command) != facts.end());

    const Outcome named = run(TINY_FIGURE_PROGRAM, {"-o", "x.exr", "--size", "3x2", "--report", "-"}, folder.path());
    REQUIRE(named.status == 0);
    CHECK(folder.names() == Names{"tiny.exr", "tiny.png", "x.exr"});
    CHECK(load_image(folder.path("x.exr")).width() == 3);
    CHECK(nlohmann::json::parse(named.out)["scene"] == "tiny");
}

TEST_CASE("Figure program: the texture is read in the encoding that is asked for, and never replaced", "[cli]") {
    const Folder folder;
    const double half = srgb_decode(128.0 / 255);
    save_image(Image(1, 1, {half, half, half}), folder.path("grey.png"));
    const std::string before = folder.read("grey.png");
    const auto centre = [&](const Words& more) {
        Words words = {"--texture", "grey.png", "-o", "x.exr"};
        words.insert(words.end(), more.begin(), more.end());
        REQUIRE(run(TINY_FIGURE_PROGRAM, words, folder.path()).status == 0);
        return load_image(folder.path("x.exr")).at(3, 2).g;
    };
    // The 128th of 256 grey levels, at the precision of a float image.
    CHECK(centre({}) == Approx(half).epsilon(1e-6));
    CHECK(centre({"--texture-encoding", "auto"}) == Approx(half).epsilon(1e-6));
    CHECK(centre({"--texture-encoding", "srgb"}) == Approx(half).epsilon(1e-6));
    CHECK(centre({"--texture-encoding", "raw"}) == Approx(128.0 / 255).epsilon(1e-6));

    const Outcome replaced = run(TINY_FIGURE_PROGRAM, {"--texture", "grey.png", "-o", "grey.png"}, folder.path());
    CHECK(replaced.status == 2);
    CHECK(folder.read("grey.png") == before);
}

TEST_CASE("Figure program: interrupted before the first sample it saves nothing and says so", "[cli]") {
    const Folder folder;
    const Outcome outcome = run(TINY_FIGURE_PROGRAM, {"--texture", "interrupt", "--report", "r.json"}, folder.path());
    CHECK(outcome.status == 130);
    CHECK(outcome.err.find("nothing was saved") != std::string::npos);
    CHECK(folder.names().empty());
}

TEST_CASE("Figure program: refuses as limn does, under its own name", "[cli]") {
    const Folder folder;
    const Outcome encoding = run(TINY_FIGURE_PROGRAM, {"--texture-encoding", "cmyk"}, folder.path());
    CHECK(encoding.status == 2);
    CHECK(encoding.err.starts_with("tiny: "));
    CHECK(encoding.err.find("cmyk") != std::string::npos);
    const Outcome missing = run(TINY_FIGURE_PROGRAM, {"--texture", "none.png"}, folder.path());
    CHECK(missing.status == 1);
    CHECK(missing.err.find("none.png") != std::string::npos);
    const Outcome unnamed = run(TINY_FIGURE_PROGRAM, {"--texture", ""}, folder.path());
    CHECK(unnamed.status == 2);
    CHECK(unnamed.err == "tiny: --texture '': is not the name of a file\n");
    CHECK(folder.names().empty());
}

}  // namespace
}  // namespace limn::test::figure_program_test
