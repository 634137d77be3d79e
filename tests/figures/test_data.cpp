// The readers of the figures' data files: what they accept, and what they say of what they do not.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "catch.h"
#include "figure_data.h"
#include "support.h"

namespace limn::test_data {

using figures::data_file;
using figures::read_bouncing_spheres;
using figures::read_perlin_lattice;

namespace {

// A file with the given text, removed at the end.
class TextFile {
public:
    explicit TextFile(const std::string& text)
        : path(std::filesystem::temp_directory_path() / ("limn-data-" + std::to_string(getpid()) + ".txt")) {
        std::ofstream(path, std::ios::binary) << text;
    }
    ~TextFile() { std::filesystem::remove(path); }
    const std::string path;
};

std::string text_of(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

// The text with the first `from` replaced by `to`.
std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

template <class Read>
std::string message_of(const Read& read, const std::string& text) {
    const TextFile file(text);
    try {
        read(file.path);
    } catch (const FileError& e) {
        CHECK(e.path() == file.path);
        return e.what();
    }
    return "";
}

const std::string kHeading = "cx0,cy0,cz0,cx1,cy1,cz1,radius,material,r,g,b,param\n";
const std::string kBall = "1,2,3,4,5,6,.5,metal,.1,.2,.3,.25\n";

}  // namespace

TEST_CASE("Balls are read as they stand in the file", "[figures]") {
    const TextFile file(kHeading + kBall + "0,0,0,0,0,0,1,dielectric,1,1,1,1.5\r\n");
    const auto balls = read_bouncing_spheres(file.path);
    REQUIRE(balls.size() == 2);
    CHECK((balls[0].center0 == Point3{1, 2, 3} && balls[0].center1 == Point3{4, 5, 6} && balls[0].radius == .5));
    CHECK((balls[0].material == "metal" && balls[0].color == Color{.1, .2, .3} && balls[0].parameter == .25));
    CHECK((balls[1].material == "dielectric" && balls[1].parameter == 1.5));
}

TEST_CASE("A file of balls that is missing or malformed is refused, by file and line", "[figures]") {
    using Catch::Matchers::Contains;
    CHECK_THROWS_AS(read_bouncing_spheres("/no/such/file.csv"), FileError);
    const auto message = [](const std::string& text) { return message_of(read_bouncing_spheres, text); };
    CHECK_THAT(message(""), Contains("no sphere"));
    CHECK_THAT(message(kHeading), Contains("no sphere"));
    CHECK_THAT(message(kBall), Contains("line 1") && Contains("heading"));
    CHECK_THAT(message(kHeading + kBall + "1,2,3\n"), Contains("line 3") && Contains("3 fields"));
    CHECK_THAT(message(kHeading + with(kBall, ".5", "x")), Contains("line 2") && Contains("'x'"));
    CHECK_THAT(message(kHeading + with(kBall, ".5", "nan")), Contains("line 2") && Contains("finite"));
    CHECK_THAT(message(kHeading + with(kBall, "metal", "wood")), Contains("line 2") && Contains("wood"));
}

TEST_CASE("The lattice of the figures is read, and a damaged one refused, by file and line", "[figures]") {
    using Catch::Matchers::Contains;
    const auto lattice = read_perlin_lattice(data_file("perlin_lattice.txt"));
    for (const Vec3& gradient : lattice->gradients) CHECK(length(gradient) == Approx(1).margin(1e-15));
    CHECK(lattice->gradients[0] == Vec3{0.85853680761595363, 0.42501216277055043, -0.2868435313297239});

    CHECK_THROWS_AS(read_perlin_lattice("/no/such/lattice.txt"), FileError);
    const std::string text = text_of(data_file("perlin_lattice.txt"));
    const auto message = [](const std::string& damaged) { return message_of(read_perlin_lattice, damaged); };
    CHECK(message(text) == "");
    CHECK_THAT(message(with(text, "0.85853680761595363 ", "")), Contains("line 2") && Contains("2 fields"));
    CHECK_THAT(message(with(text, "0.85853680761595363", "inf")), Contains("line 2") && Contains("finite"));
    CHECK_THAT(message(text + "1 2 3\n"), Contains("line 514"));
    CHECK_THAT(message("# nothing\n"), Contains("0 rows"));
    const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
    CHECK_THAT(message(text.substr(0, last)), Contains("511 rows"));
    CHECK_THAT(message(text.substr(0, last) + "256 1 1\n"), Contains("line 513") && Contains("'256'"));
    CHECK_THAT(message(text.substr(0, last) +
                       text.substr(text.rfind('\n', last - 2) + 1, last - text.rfind('\n', last - 2) - 1)),
               Contains("permutation"));
}

TEST_CASE("LIMN_FIGURE_DATA names another folder for the data", "[figures]") {
    const std::string usual = data_file("cube.obj");
    REQUIRE(setenv("LIMN_FIGURE_DATA", "/elsewhere", 1) == 0);
    const std::string other = data_file("cube.obj");
    REQUIRE(unsetenv("LIMN_FIGURE_DATA") == 0);
    CHECK(other == "/elsewhere/cube.obj");
    CHECK(std::filesystem::exists(usual));
}

}  // namespace limn::test_data
