// The measuring program with few rays: every ray is judged, and what is wrong is counted.
#include <nlohmann/json.hpp>

#include "catch.h"
#include "cli/process.h"

using namespace limn::test;
using Json = nlohmann::json;

namespace {

Outcome measure(Words words) {
    words.insert(words.end(), {"--rays", "100", "--leak-rays", "3000"});
    return run(LIMN_ACCURACY_PROGRAM, words);
}

Json groups(const Words& words) {
    const Outcome outcome = measure(words);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return Json::parse(outcome.out)["groups"];
}

Json sum(const Json& group, std::size_t column, const std::string& what) {
    std::uint64_t total = 0;
    for (const Json& row : group["rows"]) total += row["cells"][column][what].get<std::uint64_t>();
    return total;
}

}  // namespace

TEST_CASE("Accuracy: every row of every table judges each of its rays, for every column", "[accuracy]") {
    for (const char* name : {"spheres", "triangles", "leaks", "quads", "quad-leaks", "slabs", "instances", "leaving",
                             "far-origins", "queries"}) {
        for (const Json& group : groups({name})) {
            CHECK(group["rows"].size() >= 6);
            for (const Json& row : group["rows"]) {
                INFO(name << ": " << row["case"]);
                CHECK(row["rays"] == row["judged"]);
                CHECK(row["rays"] > 0);
                CHECK(row["cells"].size() == group["columns"].size());
                for (std::size_t k = 0; k < row["cells"].size(); ++k) {
                    const Json& asked = row["cells"][k]["asked"];
                    const std::string column = group["columns"][k];
                    if (column == "limn, hit()") {
                        CHECK((asked == row["rays"] || asked == 0));  // where it would take too long
                    } else if (column.find("Embree") == 0) {
                        CHECK((asked == row["rays"] || asked == 32));  // where it would cost many processes
                    } else {
                        CHECK(asked == row["rays"]);
                    }
                }
            }
        }
    }
}

TEST_CASE("Accuracy: who counts hits as crossings is wrong where limn is not", "[accuracy]") {
    const Json group = groups({"queries"})[0];
    REQUIRE(group["columns"].back() == "hits counted");
    CHECK(sum(group, 4, "false_hits") > 100);
    for (const std::size_t column : {0u, 1u, 2u, 3u}) CHECK(sum(group, column, "false_hits") == 0);
}

TEST_CASE("Accuracy: the textbook's triangles leak where limn does not", "[accuracy]") {
    const Json group = groups({"leaks"})[0];
    REQUIRE(group["columns"].front() == "limn");
    CHECK(sum(group, 0, "false_misses") == 0);
    const std::size_t last = group["columns"].size() - 1;
    CHECK(sum(group, last, "false_misses") > 0);      // Pluecker
    CHECK(sum(group, last - 1, "false_misses") > 0);  // Moeller and Trumbore
}

TEST_CASE("Accuracy: float32 errs about small spheres far away in both directions, and about t", "[accuracy]") {
    const Json group = groups({"spheres"})[0];
    const std::size_t book = group["columns"].size() - 2;
    REQUIRE(group["columns"][book] == "book, float32");
    CHECK(sum(group, book, "false_hits") > 0);
    CHECK(sum(group, book, "false_misses") > 0);
    CHECK(group["rows"][0]["cells"][book]["t_ulps"] > 100);
    CHECK(group["rows"][0]["cells"][0]["t_ulps"] <= 1);
}

TEST_CASE("Accuracy: a point rounded to float32 is no safe place to leave from", "[accuracy]") {
    const Json group = groups({"leaving"})[0];
    CHECK(sum(group, 0, "self_hits") == 0);
    CHECK(sum(group, 0, "lost") == 0);
    CHECK(sum(group, 1, "self_hits") > 0);
    CHECK(sum(group, 1, "lost") > 0);
}

TEST_CASE("Accuracy: numbers do not depend on threads", "[accuracy]") {
    for (const char* name : {"triangles", "leaving"})
        CHECK(groups({name, "--threads", "1"}) == groups({name, "--threads", "3"}));
}

TEST_CASE("Accuracy: wrong arguments are refused", "[accuracy]") {
    for (const Words& words : {Words{"sphere"}, Words{"--rays", "0"}, Words{"--rays", "1e3"}, Words{"--threads", "-1"},
                               Words{"leaks", "--rays"}}) {
        const Outcome outcome = run(LIMN_ACCURACY_PROGRAM, words);
        CHECK(outcome.status == 2);
        CHECK(outcome.out.empty());
        CHECK(outcome.err.find("usage") != std::string::npos);
    }
}
