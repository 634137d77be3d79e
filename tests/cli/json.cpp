// What the programs write as JSON, as nlohmann's parser reads it back.
#include <nlohmann/json.hpp>

#include "catch.h"
#include "json_output.h"
#include "limn/math/math.h"

namespace limn::app::json_test {
namespace {

nlohmann::ordered_json read_back(const Json& json) { return nlohmann::ordered_json::parse(json_text(json)); }

TEST_CASE("JSON: every kind of value is read back as it was, and what is not a finite number as null", "[cli][json]") {
    CHECK(read_back(nullptr).is_null());
    CHECK(read_back(true) == true);
    CHECK(read_back(-3) == -3);
    CHECK(read_back(18446744073709551615u) == 18446744073709551615u);
    CHECK(read_back(0.1).get<double>() == 0.1);
    CHECK(json_text(4.0) == "4.0\n");  // a float, not an integer
    CHECK(read_back("\"\n") == "\"\n");
    CHECK(read_back(kInfinity).is_null());
    CHECK(read_back(-kInfinity).is_null());
    CHECK(read_back(std::numeric_limits<double>::quiet_NaN()).is_null());
    CHECK(json_text("\xff") == "\"\xef\xbf\xbd\"\n");  // names of files need not be UTF-8
}

TEST_CASE("JSON: pairs of a name and a value make an object in their order, anything else an array", "[cli][json]") {
    CHECK(json_text({{"b", 1}, {"a", {1.5, "x"}}}) == "{\n  \"b\": 1,\n  \"a\": [\n    1.5,\n    \"x\"\n  ]\n}\n");
    CHECK(read_back({1, 2}).is_array());
    CHECK(read_back({{1, 2}, {3, 4}}).is_array());
    CHECK(read_back({{"a", 2}, {3, 4}}).is_array());
    CHECK(read_back(Json::array()) == nlohmann::ordered_json::array());
    CHECK(read_back(Json::object()) == nlohmann::ordered_json::object());
    CHECK(read_back(std::vector<double>{}) == nlohmann::ordered_json::array());
    CHECK(read_back(std::vector<std::string>{"a", "b"}) == nlohmann::ordered_json({"a", "b"}));
}

TEST_CASE("JSON: members are added once, and replaced where they are", "[cli][json]") {
    Json json = Json::object();
    json["list"] = Json::array();
    json["list"].push_back({{"x", 1}});
    json["other"] = 2;
    json.update({{"list", 3}, {"more", 4}});
    json["other"] = 5;
    CHECK(read_back(json).dump() == R"({"list":3,"other":5,"more":4})");
}

}  // namespace
}  // namespace limn::app::json_test
