// How `limn trace` reads and writes, and what it refuses.
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include "catch.h"
#include "process.h"
#include "ray_forms.h"
#include "support/folder.h"
#include "support/text.h"

namespace limn::test::trace_streams_test {
namespace {

const std::string kRay = std::string(kTriangleRay) + "\n", kAnswer = std::string(kTriangleAnswer) + "\n";

// A model that the rays of this file are traced in.
struct Triangle {
    Folder folder;
    std::string model = folder.write("a.obj", kTriangleObj);
};

TEST_CASE("limn trace: lines may end as on any system, be blank, be comments, and the last one may lack its end",
          "[cli][trace]") {
    const Triangle t;
    const std::string ray = kTriangleRay;
    const std::string inputs[] = {ray + "\n" + ray + "\n",
                                  ray + "\n" + ray,
                                  ray + "\r\n" + ray + "\r\n",
                                  ray + "\r\n" + ray,
                                  "\n  \n\t\r\n" + ray + "\n# 1 2 3\n#\n  # x\n" + ray + "\n\n",
                                  "\t 1\t2   3 +0 0 -2e0 \n1 2 3 0 0 -2 0 +INF",
                                  "+1 2.0 3. 0 0 -20e-1 -0 infinity\n" + ray + "\n# the end"};
    for (const std::string& input : inputs) {
        CAPTURE(input);
        const Outcome outcome = limn_reads(input, {"trace", t.model});
        CHECK(outcome.status == 0);
        CHECK(outcome.out == kAnswer + kAnswer);
        CHECK(outcome.err.empty());
    }
    for (const std::string input : {"", "\n", "# nothing\n"}) {
        const Outcome outcome = limn_reads(input, {"trace", t.model});
        CHECK(outcome.status == 0);
        CHECK((outcome.out + outcome.err).empty());
    }
}

TEST_CASE("limn trace: rays come from a file, from standard input, or from - for the latter", "[cli][trace]") {
    const Triangle t;
    const std::string file = t.folder.write("rays", kRay + kRay);
    CHECK(limn_reads("", {"trace", t.model, "--rays", file}).out == kAnswer + kAnswer);
    CHECK(limn_reads(kRay, {"trace", t.model, "--rays", "-"}).out == kAnswer);
    CHECK(limn_reads("", {"trace", t.model, "--rays", "/dev/null"}).out.empty());
}

TEST_CASE("limn trace: a malformed line ends it with status 1, its number, and the answers before it", "[cli][trace]") {
    const Triangle t;
    const std::pair<std::string, std::string> cases[] = {{"1 2 3 0 0", "not 5"},
                                                         {"1 2 3 0 0 -2 0", "not 7"},
                                                         {"1 2 3 0 0 -2 0 inf 1", "more than 8"},
                                                         {"1 2 three 0 0 -2", "'three'"},
                                                         {"1,2,3,0,0,-2", "'1,2,3,0,0,-2'"},
                                                         {"1 2 3 0 0 -2x", "'-2x'"},
                                                         {"1 2 3 0 0 -2 # why", "'#'"},
                                                         {"1 2 0x3 0 0 -2", "'0x3'"},
                                                         {"+-1 2 3 0 0 -2", "'+-1'"},
                                                         {"++1 2 3 0 0 -2", "'++1'"},
                                                         {"1 2 + 0 0 -2", "'+'"},
                                                         {"1 2 1e400 0 0 -2", "1e400' is beyond"},
                                                         {std::string("1 2 3 0 0 -2\0", 13), "'-2?' is not a number"},
                                                         {"1 2 3 0 0 -2 \xc3\xa4", "not a number"},
                                                         {std::string(100'000, '7'), "longer than"},
                                                         {"#" + std::string(100'000, '#'), "longer than"}};
    for (const auto& [line, problem] : cases) {
        CAPTURE(line.substr(0, 80));
        const Outcome outcome = limn_reads(kRay + "# two\n\n" + kRay + line + "\n" + kRay, {"trace", t.model});
        CHECK(outcome.status == 1);
        CHECK(outcome.out == kAnswer + kAnswer);
        CHECK(outcome.err.starts_with("limn: standard input:5: "));
        CHECK(contains(outcome.err, problem));
    }
    const std::string file = t.folder.write("rays", kRay + "1 2 3");
    CHECK(limn_reads("", {"trace", t.model, "--rays", file}).err.starts_with("limn: " + file + ":2: "));
}

TEST_CASE("limn trace: lines are counted, and answered, over many blocks of input", "[cli][trace]") {
    const Triangle t;
    constexpr std::size_t kRays = 30'000;
    std::string input;
    for (std::size_t i = 0; i < kRays; ++i) input += "1 2 3 0 0 -2" + std::string(i % 97, ' ') + "\n";
    REQUIRE(input.size() > std::size_t{3} << 19);  // not a whole number of the blocks that are read
    const Outcome outcome = limn_reads(input + "1 2 3 0 0", {"trace", t.model, "--any"});
    CHECK(outcome.status == 1);
    CHECK(outcome.out.size() == 2 * kRays);
    CHECK(contains(outcome.err, fmt::format("input:{}: ", kRays + 1)));
}

TEST_CASE("limn trace: a line that never ends is refused, not gathered", "[cli][trace]") {
    const Outcome outcome = limn_reads("", {"trace", Triangle().model, "--rays", "/dev/zero"});
    CHECK(outcome.status == 1);
    CHECK(contains(outcome.err, "/dev/zero:1: "));
}

TEST_CASE("limn trace: binary input that ends within a ray ends with status 1 after the answers before it",
          "[cli][trace]") {
    const Triangle t;
    const std::string ray = to_binary({1, 2, 3, 0, 0, -2, 0, kInfinity});
    for (const std::size_t extra : {1u, 8u, 63u}) {
        const Outcome outcome = limn_reads(ray + ray + ray.substr(0, extra), {"trace", t.model, "--binary"});
        CHECK(outcome.status == 1);
        CHECK(outcome.out == to_binary({1.5, 0, 0.25, 0.5, 1.5, 0, 0.25, 0.5}));
        CHECK(contains(outcome.err, fmt::format("standard input: ends within a ray: {} bytes", 128 + extra)));
    }
    CHECK(limn_reads("", {"trace", t.model, "--binary"}).status == 0);
}

TEST_CASE("limn trace: files that cannot be read end with status 1 and their name", "[cli][trace]") {
    const Triangle t;
    const std::pair<Words, std::string> cases[] = {
        {{"trace", t.folder.path("none.obj")}, "none.obj: "},
        {{"trace", t.folder.path()}, t.folder.path() + ": "},
        {{"trace", t.folder.write("b.obj", "v 0 0 0\nf 1 2 3\n")}, "b.obj: line 2"},
        {{"trace", t.model, "--rays", t.folder.path("none")}, "none: No such file"},
        {{"trace", t.model, "--rays", t.folder.path()}, t.folder.path() + ": is a folder"},
    };
    for (const auto& [words, message] : cases) {
        CAPTURE(words);
        const Outcome outcome = limn_reads("", words);
        CHECK(outcome.status == 1);
        CHECK(contains(outcome.err, message));
        CHECK(outcome.out.empty());
    }
}

TEST_CASE("limn trace: what is wrong with a model's materials is said on stderr, not with --quiet", "[cli][trace]") {
    const Folder folder;
    const std::string model = folder.write("a.obj", "mtllib none.mtl\n" + std::string(kTriangleObj));
    const Outcome outcome = limn_reads(kRay, {"trace", model});
    CHECK(outcome.status == 0);
    CHECK(outcome.out == kAnswer);
    CHECK(contains(outcome.err, "none.mtl"));
    CHECK(limn_reads(kRay, {"trace", model, "--quiet"}).err.empty());
}

TEST_CASE("limn trace: each answer comes before the next ray is sent", "[cli][trace]") {
    const Triangle t;
    Conversation text({"trace", t.model});
    for (int i = 0; i < 3; ++i) {
        text.say("1 2 3 0 ");
        text.say("0 -2\n1 2");  // and the beginning of a line that takes its time
        CHECK(text.hear(kAnswer.size()) == kAnswer);
        text.say(" 3 0 0 -2\n");
        CHECK(text.hear(kAnswer.size()) == kAnswer);
    }
    CHECK(text.finish().status == 0);

    Conversation binary({"trace", t.model, "--binary", "--any"});
    const std::string ray = to_binary({1, 2, 3, 0, 0, -2, 0, kInfinity}), yes = to_binary({1});
    for (int i = 0; i < 3; ++i) {
        binary.say(ray + ray.substr(0, 31));
        CHECK(binary.hear(yes.size()) == yes);
        binary.say(ray.substr(31));
        CHECK(binary.hear(yes.size()) == yes);
    }
    CHECK(binary.finish().status == 0);
}

TEST_CASE("limn trace: answers that nobody takes, or that find no room, end it with status 1", "[cli][trace]") {
    const Triangle t;
    Conversation closed({"trace", t.model});
    closed.stop_listening();
    closed.say(kRay);
    const Outcome outcome = closed.finish();
    CHECK(outcome.status == 1);
    CHECK(contains(outcome.err, "standard output: Broken pipe"));

    const Outcome full = limn_writes("/dev/full", {"trace", t.model, "--rays", t.folder.write("rays", kRay)});
    CHECK(full.status == 1);
    CHECK(contains(full.err, "standard output: No space"));
}

TEST_CASE("limn trace: a bar is drawn where the end is known, and not with --quiet", "[cli][trace]") {
    const Triangle t;
    const Words from_file = {"trace", t.model, "--rays", t.folder.write("rays", kRay)};
    const auto terminal = [](const Words& words, const Words& more) {
        Words all = words;
        all.insert(all.end(), more.begin(), more.end());
        const Outcome outcome = OnTerminal(LIMN_PROGRAM, all).finish();
        CHECK(outcome.status == 0);
        return outcome.err;
    };
    const std::string drawn = terminal(from_file, {});
    CHECK(contains(drawn, "100 %"));
    CHECK(drawn.ends_with("\r\033[K"));
    CHECK(terminal(from_file, {"--quiet"}).empty());
    CHECK(terminal({"trace", t.model}, {}).empty());
}

TEST_CASE("limn trace: float64 does not go to a terminal", "[cli][trace]") {
    const Triangle t;
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE((terminal >= 0 && grantpt(terminal) == 0 && unlockpt(terminal) == 0));
    const Outcome outcome = limn_writes(ptsname(terminal), {"trace", t.model, "--binary"});
    close(terminal);
    CHECK(outcome.status == 2);
    CHECK(contains(outcome.err, "--binary"));
}

}  // namespace
}  // namespace limn::test::trace_streams_test
