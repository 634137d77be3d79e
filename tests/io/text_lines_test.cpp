#include "io/text_lines.h"

#include <charconv>
#include <cmath>
#include <locale>
#include <random>

#include "catch.h"
#include "formats.h"

namespace limn::text_lines_test {

using namespace test;

namespace {

struct Line {
    std::size_t number;
    std::vector<std::string> words;
    bool operator==(const Line&) const = default;
};

std::vector<Line> lines_of(std::string_view text) {
    std::vector<Line> result;
    for (TextLines lines(text); lines.next();) {
        const auto words = lines.words();
        result.push_back({lines.number(), {words.begin(), words.end()}});
    }
    return result;
}

// A program in a locale with decimal commas and grouped thousands.
struct CommaDecimals : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

}  // namespace

TEST_CASE("Lines: LF, CR LF and CR end a line, the last one needs no end", "[io][obj]") {
    const std::vector<Line> expected{{1, {"a", "b"}}, {2, {}}, {3, {"c"}}};
    CHECK(lines_of("a b\n\nc") == expected);
    CHECK(lines_of("a b\r\n\r\nc\r\n") == expected);
    CHECK(lines_of("a\tb\r\r  c ") == expected);
    CHECK(lines_of("\xef\xbb\xbf"
                   "a b\n\nc\n") == expected);
    CHECK(lines_of("").empty());
}

TEST_CASE("Lines: a backslash at the end joins lines, which keep their numbers", "[io][obj]") {
    CHECK(lines_of("f 1 2 \\\n3\\\r\n4\nv") == std::vector<Line>{{1, {"f", "1", "2", "3", "4"}}, {4, {"v"}}});
    CHECK(lines_of("# in C:\\models\\\nv 1") == std::vector<Line>{{1, {}}, {2, {"v", "1"}}});
    CHECK(lines_of("v 1\\") == std::vector<Line>{{1, {"v", "1"}}});
}

TEST_CASE("Lines: words end at a comment, the rest of a line does not", "[io][obj]") {
    CHECK(lines_of("v 1 # 2") == std::vector<Line>{{1, {"v", "1"}}});
    TextLines lines("usemtl  dark #3 \t");
    REQUIRE(lines.next());
    CHECK(lines.name() == "dark #3");
}

TEST_CASE("Numbers: a decimal becomes the nearest float32, ties to even", "[io][obj]") {
    const std::pair<const char*, float> cases[] = {
        {"1", 1},
        {"+1.5", 1.5f},
        {"-0", -0.0f},
        {".5", 0.5f},
        {"5.", 5},
        {"1e3", 1000},
        {"1E-3", 0.001f},
        {"1.000000059604644775390625", 1},                               // half way between 1 and its successor
        {"1.00000005960464477539062500000000000000001", 0x1.000002p0f},  // in double, this is half way too
        {"1.000000178813934326171875", 0x1.000004p0f},                   // half way, the even one is above
        {"3.4028235e38", 0x1.fffffep127f},
        {"1e-45", 0x1p-149f},
        {"1e-60", 0},
        {"-1e-400", -0.0f}};
    for (const auto& [word, expected] : cases) {
        CAPTURE(word);
        const auto value = parse_float(word);
        REQUIRE(value);
        CHECK(bits(*value) == bits(expected));
    }
}

TEST_CASE("Numbers: what is no finite float32 is none", "[io][obj]") {
    for (const char* word :
         {"",   "+",  "-",   "+-1",  "--1", ".",        "e5",   "1e",    "1,5",          "0x10",  "1d5", "1.0f",
          "1 ", " 1", "nan", "-nan", "inf", "Infinity", "1e40", "-1e40", "3.4028236e38", "1e400", "one"}) {
        CAPTURE(word);
        CHECK_FALSE(parse_float(word));
    }
}

TEST_CASE("Numbers: printed with 9 digits, any float32 reads back, in any locale", "[io][obj]") {
    const std::locale before = std::locale::global(std::locale(std::locale(), new CommaDecimals));
    std::mt19937 generator(3);
    std::size_t wrong = 0;
    for (int i = 0; i < 200'000; ++i) {
        const float value = std::bit_cast<float>(static_cast<std::uint32_t>(generator()));
        if (!std::isfinite(value)) continue;
        char digits[32];
        const char* end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 9).ptr;
        std::string shortest;
        append_number(shortest, value);
        for (const auto& read : {parse_float({digits, end}), parse_float(shortest)})
            wrong += !read || bits(*read) != bits(value);
    }
    const auto tiny = parse_float("1e-60");
    std::locale::global(before);
    CHECK(wrong == 0);
    CHECK(tiny == 0.0f);
}

}  // namespace limn::text_lines_test
