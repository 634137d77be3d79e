// Checkpoints, shards and merges on the command line.
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "catch.h"
#include "house.h"
#include "limn/io/image_io.h"
#include "limn/math/system/file_lock.h"
#include "process.h"
#include "support/folder.h"
#include "support/text.h"

namespace limn::test::films_test {
namespace {

using Json = nlohmann::json;

Words operator+(Words a, const Words& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

// `limn render` of a small model, in a folder of its own.
struct Render {
    Folder folder;
    Words common = {"render", "house.obj", "--size", "48x40", "--seed", "3", "--quiet"};

    Render() { folder.write("house.obj", house_obj()); }
    Outcome operator()(const Words& words) const { return limn(common + words, folder.path()); }
    // The picture's values and channels, and what of the report must be the same in two runs of one render.
    Json facts(const std::string& name) const {
        Json report = Json::parse(folder.read(name + ".json"));
        for (const char* other : {"seconds", "threads", "mrays_per_second", "memory_bytes"}) report.erase(other);
        return report;
    }
    void check_same(const std::string& a, const std::string& b) const {
        CHECK(load_image(folder.path(a + ".exr")) == load_image(folder.path(b + ".exr")));
        CHECK(facts(a) == facts(b));
    }
    Words written(const std::string& name) const {
        return {"-o", name + ".exr", "--report", name + ".json", "--channels", "error,samples"};
    }
};

int kills(int ordinarily) { return std::getenv("LIMN_FULL") ? 60 : ordinarily; }

TEST_CASE("Films: killed at any moment and resumed, a render is the one that was not", "[cli][films]") {
    std::mt19937 generator(11);
    for (const Words& goal : {Words{"--spp", "400"}, Words{"--error", "3e-4"}}) {
        const Render render;
        REQUIRE(render(goal + render.written("whole")).status == 0);
        int killed = 0;
        for (int i = 0; i < kills(4); ++i) {
            // Every other time without a picture, for which the program spends most of its time loading OpenImageIO.
            const bool saves = i % 2 == 0;
            const Words words = render.common + goal + (saves ? render.written("resumed") : Words{}) +
                                Words{"--checkpoint", "a.film", "--every",   "0.02",
                                      "--resume",     "a.film", "--threads", std::to_string(1 + i % 3)};
            // Until it is not killed any more.
            for (int longest = 100;; longest += 100) {
                const pid_t child = fork();
                if (child == 0) {
                    if (chdir(render.folder.path().c_str()) != 0) _exit(99);
                    std::vector<char*> arguments{const_cast<char*>(LIMN_PROGRAM)};
                    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
                    arguments.push_back(nullptr);
                    execv(LIMN_PROGRAM, arguments.data());
                    _exit(99);
                }
                std::this_thread::sleep_for(std::chrono::milliseconds(generator() % static_cast<unsigned>(longest)));
                kill(child, SIGKILL);
                int status = 0;
                waitpid(child, &status, 0);
                if (WIFEXITED(status)) {
                    CHECK(WEXITSTATUS(status) == 0);
                    break;
                }
                ++killed;
            }
            if (!saves) {
                REQUIRE(render(goal + Words{"--resume", "a.film"} + render.written("resumed")).status == 0);
            }
            render.check_same("whole", "resumed");
            CHECK(render.folder.names() ==
                  Names{"a.film", "house.obj", "resumed.exr", "resumed.json", "whole.exr", "whole.json"});
            std::filesystem::remove(render.folder.path("a.film"));
        }
        CHECK(killed > 0);
    }
}

TEST_CASE("Films: interrupted, a render leaves its film, from which another goes on", "[cli][films]") {
    const Render render;
    REQUIRE(render(Words{"--spp", "300"} + render.written("whole")).status == 0);
    REQUIRE(render(Words{"--spp", "100000000", "--time-limit", "0.1", "--film", "a.film", "-o", "a.exr"}).status == 0);
    const Outcome info = limn({"info", "a.film"}, render.folder.path());
    CHECK(info.status == 0);
    CHECK(contains(info.out, "48 x 40"));
    // Another time limit, other threads, other samples.
    CHECK(render(Words{"--spp", "8", "--film", "b.film", "--threads", "1"}).status == 0);
    CHECK(render(Words{"--spp", "300", "--resume", "b.film"} + render.written("resumed")).status == 0);
    render.check_same("whole", "resumed");
}

TEST_CASE("Films: shards are merged to the picture of one run, in any order", "[cli][films]") {
    const Render render;
    REQUIRE(render(Words{"--spp", "12"} + render.written("whole")).status == 0);
    for (const char* i : {"1", "2", "3"}) {
        const std::string film = std::string(i) + ".film";
        const Outcome shard = render({"--spp", "12", "--shard", std::string(i) + "/3", "--film", film});
        INFO(shard.err);
        REQUIRE(shard.status == 0);
    }
    for (const Words& films : {Words{"1.film", "2.film", "3.film"}, Words{"3.film", "1.film", "2.film"}}) {
        const Outcome merged = limn(Words{"merge"} + films + render.written("resumed"), render.folder.path());
        INFO(merged.err);
        REQUIRE(merged.status == 0);
        render.check_same("whole", "resumed");
    }
    // What no film knows is traced by a render that takes no sample more.
    const Words all = {"merge", "1.film", "2.film", "3.film", "--quiet", "--film", "all.film"};
    REQUIRE(limn(all, render.folder.path()).status == 0);
    REQUIRE(render({"--spp", "12", "--resume", "all.film", "-o", "hits.exr", "--channels", "depth"}).status == 0);
    CHECK(load_image(render.folder.path("hits.exr")) == load_image(render.folder.path("whole.exr")));
    CHECK(load_image_info(render.folder.path("hits.exr")).channels.size() == 4);

    const auto refused = [&](const Words& words, int status, const std::string& message) {
        const Outcome outcome = limn(Words{"merge"} + words, render.folder.path());
        CAPTURE(words, outcome.err);
        CHECK(outcome.status == status);
        CHECK(contains(outcome.err, message));
    };
    refused({"1.film", "3.film", "-o", "x.exr"}, 1,
            "1.film: and the other files are not the whole picture: missing are shards 2/3");
    refused({"1.film", "2.film", "2.film", "3.film", "-o", "x.exr"}, 1, "2.film: has pixels that 2.film has too");
    refused({"1.film", "none.film", "-o", "x.exr"}, 1, "none.film: there is no such file");
    refused({"1.film", "whole.exr", "-o", "x.exr"}, 1, "whole.exr: is not a film");
    refused({"1.film", "2.film", "3.film"}, 2, "-o is missing");
    refused({"1.film", "-o", "x.exr", "--film", "1.film"}, 2, "1.film: would replace a file that is read");
    refused({"1.film", "-o", "x.exr", "--error", "0.1"}, 2, "--plan");
    refused({"1.film", "-o", "x.exr", "--error", "0", "--plan", "p"}, 2, "--error 0: must be over 0");
    refused({"-o", "x.exr"}, 2, "FILM");
    CHECK(render.folder.names().count("x.exr") == 0);
}

TEST_CASE("Films: a part never replaces the film of more tiles that it goes on from", "[cli][films]") {
    const Render render;
    REQUIRE(render({"--spp", "2", "--film", "whole.film"}).status == 0);
    const auto before = render.folder.contents();
    for (const char* option : {"--film", "--checkpoint"}) {
        const Outcome outcome =
            render({"--spp", "4", "--resume", "whole.film", option, "whole.film", "--shard", "1/2"});
        CHECK(outcome.status == 1);
        CHECK(contains(outcome.err, "whole.film: has more tiles than this --shard"));
        CHECK(render.folder.contents() == before);
    }
    // Into a film of its own it may go on.
    for (const char* i : {"1", "2"})
        REQUIRE(render({"--spp", "4", "--resume", "whole.film", "--film", std::string(i) + ".film", "--shard",
                        std::string(i) + "/2"})
                    .status == 0);
    CHECK(render.folder.contents().at("whole.film") == before.at("whole.film"));
    REQUIRE(render(Words{"--spp", "4"} + render.written("whole")).status == 0);
    REQUIRE(limn(Words{"merge", "1.film", "2.film"} + render.written("merged"), render.folder.path()).status == 0);
    render.check_same("whole", "merged");
}

TEST_CASE("Films: a checkpoint alone is enough to write, and stands in the summary by the name of its model",
          "[cli][films]") {
    const Render render;
    Words words = render.common + Words{"--spp", "2", "--checkpoint", "a.film"};
    std::erase(words, "--quiet");
    const Outcome outcome = limn(words, render.folder.path());
    CHECK(outcome.status == 0);
    CHECK(outcome.err.starts_with("limn: house.obj: 48x40, 2 samples a pixel"));
    CHECK(render.folder.names() == Names{"a.film", "house.obj"});
}

TEST_CASE("Films: where no plan can be made the picture is saved, and the films are named", "[cli][films]") {
    const Render render;
    REQUIRE(render({"--spp", "4", "--film", "a.film"}).status == 0);
    const Outcome merged =
        limn({"merge", "a.film", "--error", "1e-4", "--plan", "plan", "-o", "a.exr"}, render.folder.path());
    CHECK(merged.status == 1);
    CHECK(contains(merged.err, "limn: a.film: a plan needs 8 samples in each pixel"));
    CHECK(render.folder.names() == Names{"a.exr", "a.film", "house.obj"});
}

TEST_CASE("Films: rounds of shards with the plans of limn merge reach the error and then stop", "[cli][films]") {
    const Render render;
    const auto round = [&](const Words& more) {
        for (const char* i : {"1", "2"}) {
            const std::string film = std::string(i) + ".film";
            const Outcome shard =
                render(Words{"--shard", std::string(i) + "/2", "--film", film, "--resume", film} + more);
            INFO(shard.err);
            REQUIRE(shard.status == 0);
        }
        return limn(
            {"merge", "1.film", "2.film", "--error", "1e-4", "--plan", "plan", "-o", "a.exr", "--report", "a.json"},
            render.folder.path());
    };
    Outcome merged = round({"--spp", "8"});
    CHECK(merged.status == 3);
    int rounds = 1;
    for (; merged.status == 3 && rounds < 20; ++rounds) merged = round({"--plan", "plan"});
    INFO(merged.err);
    CHECK(merged.status == 0);
    CHECK(rounds > 1);
    const Json report = Json::parse(render.folder.read("a.json"));
    CHECK(report["error"]["ci95_high"] <= 1e-4);
    CHECK(report["error"]["reached"] == true);
    CHECK(report["stopped_by"] == "error");
}

TEST_CASE("Films: a clock that goes back changes nothing", "[cli][films]") {
    const Render render;
    REQUIRE(render(Words{"--spp", "12"} + render.written("whole")).status == 0);
    REQUIRE(render({"--spp", "8", "--film", "a.film"}).status == 0);
    render.folder.write("a.film.lock", "");
    render.folder.write(".limn-0.tmp", "");
    // To the resumed render, all that is there was written tomorrow.
    const auto tomorrow = std::filesystem::file_time_type::clock::now() + std::chrono::hours(24);
    for (const std::string& name : render.folder.names())
        std::filesystem::last_write_time(render.folder.path(name), tomorrow);
    const Outcome resumed =
        render(Words{"--spp", "12", "--resume", "a.film", "--checkpoint", "a.film", "--every", "0.01"} +
               render.written("resumed"));
    INFO(resumed.err);
    REQUIRE(resumed.status == 0);
    render.check_same("whole", "resumed");
    CHECK(render.folder.names() ==
          Names{"a.film", "house.obj", "resumed.exr", "resumed.json", "whole.exr", "whole.json"});
    CHECK(std::filesystem::last_write_time(render.folder.path("a.film")) < tomorrow);
}

TEST_CASE("Films: what cannot be continued or written is refused before it costs anything", "[cli][films]") {
    const Render render;
    REQUIRE(render({"--spp", "4", "--film", "a.film"}).status == 0);
    const std::string film = render.folder.read("a.film");
    const auto refused = [&](const Words& words, int status, const std::string& message) {
        const Outcome outcome = render(words);
        CAPTURE(words, outcome.err);
        CHECK(outcome.status == status);
        CHECK(contains(outcome.err, message));
        CHECK(render.folder.read("a.film") == film);
    };
    const Words exr = {"-o", "x.exr"};
    refused(exr + Words{"--checkpoint", "a.film"}, 1, "a.film: exists: add --resume");
    refused(exr + Words{"--resume", "none.film"}, 1, "none.film: there is no such file");
    refused(exr + Words{"--resume", "a.film", "--max-depth", "3"}, 1, "a.film: is not of this render: its depth limit");
    refused(exr + Words{"--resume", "a.film", "--look-from", "0,0,9"}, 1, "a.film: is not of this render: its camera");
    refused(exr + Words{"--resume", ""}, 2, "--resume ''");
    refused(exr + Words{"--every", "3"}, 2, "--every: there is no --checkpoint");
    refused(exr + Words{"--checkpoint", "c.film", "--every", "0"}, 2, "--every 0: must be over 0");
    refused({"--shard", "1/2"}, 2, "--shard: needs --film");
    refused(exr + Words{"--shard", "1/2", "--film", "b.film"}, 2, "--shard: a part of a picture");
    refused({"--shard", "1/2", "--film", "b.film", "--error", "0.1"}, 2, "--shard: excludes --error");
    refused({"--shard", "1/1000", "--film", "b.film"}, 2, "shard 1 of 1000");
    for (const char* shard : {"0/2", "3/2", "2", "a/b", "1/2/3", "1/", "/2", "-1/2"})
        refused({"--film", "b.film", "--shard", shard}, 2, "--shard");
    refused(exr + Words{"--plan", "none", "--spp", "4"}, 2, "--plan");
    refused(exr + Words{"--plan", "none"}, 1, "none: there is no such file");
    refused(exr + Words{"--plan", "a.film"}, 1, "a.film: is a film, not a plan");
    refused(exr + Words{"--film", "x.exr"}, 2, "x.exr: is named twice");
    refused(exr + Words{"--checkpoint", "no/a.film"}, 1, "no/a.film");
    {
        const FileLock lock(render.folder.path("b.film"));
        refused(exr + Words{"--checkpoint", "b.film"}, 1, "b.film: is being written by another process");
    }
    render.folder.write("b.film", film.substr(0, film.size() / 2));
    refused(exr + Words{"--resume", "b.film"}, 1, "b.film: is cut short");
    std::string damaged = film;
    damaged[damaged.size() / 2] ^= 4;
    render.folder.write("b.film", damaged);
    refused(exr + Words{"--resume", "b.film", "--checkpoint", "b.film"}, 1, "b.film: is damaged: a tile");
    CHECK(render.folder.read("b.film") == damaged);
    CHECK(render.folder.names().count("x.exr") == 0);
}

TEST_CASE("Films: a figure whose film alone is written writes no picture", "[cli][films]") {
    const Folder folder;
    CHECK(run(TINY_FIGURE_PROGRAM, {"--film", "a.film", "--quiet"}, folder.path()).status == 0);
    CHECK(folder.names() == Names{"a.film"});
    CHECK(run(TINY_FIGURE_PROGRAM, {"--resume", "a.film", "--spp", "9", "--quiet"}, folder.path()).status == 0);
    CHECK(folder.names() == Names{"a.film", "tiny.exr", "tiny.png"});
}

}  // namespace
}  // namespace limn::test::films_test
