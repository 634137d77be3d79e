// What `limn bench` measures, by tiny scenes and few rays. No time is judged.
#include <signal.h>

#include <nlohmann/json.hpp>

#include "catch.h"
#include "house.h"
#include "process.h"
#include "support/folder.h"
#include "support/text.h"

namespace limn::test::bench_test {
namespace {

using Json = nlohmann::json;

const Words kTiny{"--scale", "0.0005", "--rays", "300", "--rounds", "1", "--build-rounds", "1", "--threads", "1"};

Words bench(Words words, const Words& more = {}) {
    words.insert(words.begin(), "bench");
    words.insert(words.end(), kTiny.begin(), kTiny.end());
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

const Json* subject_of(const Json& row, const std::string& name) {
    for (const Json& subject : row["subjects"])
        if (subject["name"] == name) return &subject;
    return nullptr;
}

TEST_CASE("limn bench: every scene and kind of rays has its rows, measured once a round", "[cli][bench]") {
    const Outcome outcome = limn(bench({"--quiet", "--json", "-"}));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.err.empty());
    const Json json = Json::parse(outcome.out);
    CHECK(json["rounds"] == 1);
    CHECK_FALSE(json["versions"]["limn"].get<std::string>().empty());
    std::vector<std::string> names;
    for (const Json& scene : json["scenes"]) {
        INFO(scene["name"]);
        names.push_back(scene["name"]);
        CHECK(scene["bytes"]["limn"] > 0);
        REQUIRE(scene["builds"].size() == 1);
        CHECK(scene["builds"][0]["threads"] == 1);
        CHECK_FALSE(scene["builds"][0]["seconds"]["limn"].empty());
        std::vector<std::string> kinds;
        for (const Json& row : scene["rows"]) {
            INFO(row["rays"]);
            kinds.push_back(row["rays"]);
            CHECK(row["threads"] == 1);
            CHECK(row["count"] <= 300);
            CHECK(row["differences"] == 0);
            CHECK(row["any"] == (kinds.back() == "occlusion" || kinds.back() == "shadow"));
            const Json* const single = subject_of(row, "limn");
            REQUIRE(single != nullptr);
            CHECK((*single)["mismatches"] == 0);
            CHECK((*single)["seconds"].size() == 1);
            CHECK((*single)["million_a_second"] > 0);
            CHECK(subject_of(row, "limn batch") != nullptr);
        }
        CHECK(kinds.front() == "primary");
        CHECK(scene["rows"][0]["count"] == 300);
    }
    CHECK(names == std::vector<std::string>{"displaced sphere", "soup", "spheres", "cornell box", "forest"});
}

TEST_CASE("limn bench: a model is measured in place of the scenes, a scene and a kind alone if they are named",
          "[cli][bench]") {
    const Folder folder;
    const std::string model = folder.write("house.obj", house_obj());
    const Outcome outcome =
        limn(bench({model, "--scene", "cornell", "--kind", "shadow", "--kind", "primary", "--json", folder.path("r")}));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(contains(outcome.out, "cornell box: 18 primitives"));
    CHECK(contains(outcome.out, "house.obj: 16 primitives"));
    const Json json = Json::parse(folder.read("r"));
    REQUIRE(json["scenes"].size() == 2);
    for (const Json& scene : json["scenes"]) {
        REQUIRE(scene["rows"].size() == 2);
        CHECK(scene["rows"][0]["rays"] == "primary");
        CHECK(scene["rows"][1]["rays"] == "shadow");
    }
}

TEST_CASE("limn bench: wrong arguments end with status 2, a file that is none with 1", "[cli][bench]") {
    const Folder folder;
    const std::string model = folder.write("house.obj", house_obj()), broken = folder.write("broken.obj", "f 1 2 3\n");
    const std::vector<std::pair<Words, std::string>> cases = {
        {{"--scene", "moon"}, "--scene moon: is none of sphere"},
        {{"--kind", "x-ray"}, "--kind x-ray: is none of primary"},
        {{"--rays", "0"}, "--rays 0"},
        {{"--rays", "many"}, "--rays many: is not a whole number"},
        {{"--rounds", "0"}, "--rounds 0"},
        {{"--build-rounds", "-1"}, "--build-rounds -1"},
        {{"--threads", "0"}, "--threads 0"},
        {{"--scale", "0"}, "--scale 0"},
        {{"--scale", "nan"}, "--scale nan"},
        {{"--bogus"}, "--bogus"},
        {{""}, "MODEL ''"},
        {{model, "--json", model}, "house.obj"},
    };
    for (const auto& [words, message] : cases) {
        Words all = words;
        all.insert(all.begin(), "bench");
        const Outcome outcome = limn(all);
        INFO(message);
        INFO(outcome.err);
        CHECK(outcome.status == 2);
        CHECK(outcome.out.empty());
        CHECK(contains(outcome.err, message));
    }
    for (const std::string& path : {broken, folder.path("none.obj")}) {
        const Outcome outcome = limn(bench({path}));
        CHECK(outcome.status == 1);
        CHECK(contains(outcome.err, path));
    }
    CHECK(limn(bench({"--scene", "cornell", "--json", folder.path("no/r.json")})).status == 1);
}

TEST_CASE("limn bench: interrupted, it prints what it has and ends with 130", "[cli][bench]") {
    const Folder folder;
    OnTerminal program(LIMN_PROGRAM, {"bench", "--scene", "cornell", "--rounds", "1000", "--build-rounds", "0",
                                      "--json", folder.path("r.json")});
    REQUIRE(program.wait_for(" %"));
    REQUIRE(program.wait_for(" %"));  // drawn anew: the first rays are traced
    program.send(SIGINT);
    CHECK(program.finish().status == 130);
    const Json json = Json::parse(folder.read("r.json"));
    REQUIRE(json["scenes"].size() == 1);
    CHECK(json["scenes"][0]["name"] == "cornell box");
    CHECK(json["complete"] == false);
}

}  // namespace
}  // namespace limn::test::bench_test
