// The options, without running a program.
#include <algorithm>
#include <iterator>
#include <sstream>

#include "catch.h"
#include "limn/math/error.h"
#include "process.h"
#include "property.h"
#include "render_options.h"

namespace limn::app::options_test {
namespace {

RenderOptions parsed(std::vector<const char*> words) {
    Options command("test", "");
    RenderOptions options;
    add_render_options(command, options, "a.exr");
    words.insert(words.begin(), "test");
    command.parse(static_cast<int>(words.size()), words.data());
    return options;
}

std::string refusal(const std::vector<const char*>& words) {
    try {
        parsed(words);
    } catch (const ArgumentError& e) {
        return e.what();
    }
    return "";
}

TEST_CASE("Options: every value reaches the figure", "[cli]") {
    const char* const line =
        "-o a.exr --output=b.png --size 30x20 --spp 7 --seed 18446744073709551615 --threads 3 --max-depth unlimited "
        "--report - --quiet --estimator naive --sampler independent --error 2e-3 --time-limit .5 "
        "--uniform --channels samples,error --no-antialias --half --look-from -1,2e0,.5 --look-at 0,0,-3 "
        "--vup 0,0,1 --vfov 33 --aperture-angle 0.25 --focus-dist 4 "
        "--checkpoint c.film --every 1.5 --resume r.film --film f.film --plan p --shard 2/3";
    std::istringstream stream(line);
    const std::vector<std::string> words(std::istream_iterator<std::string>{stream}, {});
    std::vector<const char*> arguments;
    for (const std::string& word : words) arguments.push_back(word.c_str());
    const RenderOptions o = parsed(arguments);
    CHECK(o.outputs == std::vector<std::string>{"a.exr", "b.png"});
    CHECK(o.report == "-");
    CHECK((o.quiet && o.half));
    CHECK((o.checkpoint == "c.film" && o.resume == "r.film" && o.film == "f.film" && o.plan == "p"));
    CHECK(o.every == 1.5);
    Figure figure;
    figure.camera.aspect_ratio = 9.0;
    apply(o, figure);
    CHECK(figure.settings.width == 30);
    CHECK(figure.settings.height == 20);
    CHECK((figure.settings.samples_per_pixel == 7 && figure.settings.max_samples_per_pixel == 7));
    CHECK((figure.settings.error == 2e-3 && figure.settings.time_limit == 0.5));
    CHECK(figure.settings.uniform);
    CHECK((figure.settings.shard.index == 2 && figure.settings.shard.count == 3));
    CHECK(figure.settings.sampler == SamplerKind::independent);
    CHECK(o.channels == std::vector<std::string>{"samples", "error"});
    CHECK(figure.settings.seed == 18446744073709551615u);
    CHECK(figure.settings.threads == 3);
    CHECK(figure.settings.max_depth == kUnlimitedDepth);
    CHECK(figure.settings.estimator == Estimator::naive);
    CHECK_FALSE(figure.settings.antialias);
    CHECK(figure.camera.look_from == Point3{-1, 2, 0.5});
    CHECK(figure.camera.look_at == Point3{0, 0, -3});
    CHECK(figure.camera.up == Vec3{0, 0, 1});
    CHECK(figure.camera.vertical_fov == 33);
    CHECK(figure.camera.aperture_angle == 0.25);
    CHECK(figure.camera.focus_distance == 4.0);
    CHECK_FALSE(figure.camera.aspect_ratio.has_value());
}

TEST_CASE("Options: what the command line does not name stays as the figure has it", "[cli]") {
    Figure figure;
    figure.settings = {.width = 11, .height = 12, .samples_per_pixel = 13, .max_depth = 14, .seed = 15, .threads = 16};
    figure.settings.antialias = false;
    figure.settings.estimator = Estimator::naive;
    figure.settings.sampler = SamplerKind::independent;
    figure.settings.error = 0.25;
    figure.settings.time_limit = 17;
    figure.settings.max_samples_per_pixel = 18;
    figure.camera = {.look_from = {1, 2, 3},
                     .look_at = {4, 5, 6},
                     .up = {7, 8, 9},
                     .vertical_fov = 10,
                     .aspect_ratio = 1.5,
                     .aperture_angle = 11,
                     .focus_distance = 12};
    apply(parsed({}), figure);
    CHECK(figure.settings.width == 11);
    CHECK(figure.settings.height == 12);
    CHECK(figure.settings.samples_per_pixel == 13);
    CHECK(figure.settings.max_depth == 14);
    CHECK(figure.settings.seed == 15);
    CHECK(figure.settings.threads == 16);
    CHECK(figure.settings.estimator == Estimator::naive);
    CHECK(figure.settings.sampler == SamplerKind::independent);
    CHECK((figure.settings.error == 0.25 && figure.settings.time_limit == 17.0));
    CHECK(figure.settings.max_samples_per_pixel == 18);
    CHECK_FALSE(figure.settings.antialias);
    CHECK(figure.camera.look_from == Point3{1, 2, 3});
    CHECK(figure.camera.look_at == Point3{4, 5, 6});
    CHECK(figure.camera.up == Vec3{7, 8, 9});
    CHECK(figure.camera.vertical_fov == 10);
    CHECK(figure.camera.aspect_ratio == 1.5);
    CHECK(figure.camera.aperture_angle == 11);
    CHECK(figure.camera.focus_distance == 12.0);
}

TEST_CASE("Options: a value that cannot be right is refused by name", "[cli]") {
    const std::vector<std::pair<const char*, std::vector<const char*>>> bad = {
        {"--spp", {"0", "-3", "4.5", "4x", " 4", "+4", "nan", "2147483648", "99999999999999999999", "x"}},
        {"--seed", {"-1", "18446744073709551616", "0x10", "1e3"}},
        {"--threads", {"0", "-2", "1025", "all"}},
        {"--max-depth", {"0", "-1", "forever", "2147483647", "1.0"}},
        {"--size", {"0x10", "10x0", "10x-5", "10", "x", "10x", "10x10x10", "10X10", "65537x10", "4e2x400", "10 x10"}},
        {"--estimator", {"magic", "Path", "path "}},
        {"--look-from", {"1", "1,2", "1,2,", "1,2,3,4", "1,2,nan", "inf,0,0", "1,2,3 ", "1;2;3", "1,2,1e999", ",,"}},
        {"--look-at", {"0,0,0x", "a,b,c"}},
        {"--vup", {"0,0,0", "-0,0,0", "0,nan,0"}},
        {"--vfov", {"0", "180", "-20", "nan", "inf", "20deg", "360"}},
        {"--aperture-angle", {"-0.1", "180", "nan"}},
        {"--focus-dist", {"0", "-1", "inf", "1e999", "ten"}},
    };
    for (const auto& [option, values] : bad)
        for (const char* value : values) {
            CAPTURE(option, value);
            const std::string message = refusal({option, value});
            CHECK(message.find(option) != std::string::npos);
            CHECK(message.find(value) != std::string::npos);
        }
}

TEST_CASE("Options: a number out of range is told the range, and what is no number that it is none", "[cli]") {
    for (const char* value : {"0", "2147483648", "99999999999999999999", "-99999999999999999999"})
        CHECK(refusal({"--spp", value}).find("must be in 1 .. 2147483647") != std::string::npos);
    for (const char* value : {"4.5", "x", "99999999999999999999x"})
        CHECK(refusal({"--spp", value}).find("is not a whole number") != std::string::npos);
}

TEST_CASE("Options: the ends of each range are allowed", "[cli]") {
    CHECK(parsed({"--size", "1x65536"}).size->height == 65536);
    CHECK(parsed({"--spp", "1"}).samples_per_pixel == 1);
    CHECK(parsed({"--spp", "2147483647"}).samples_per_pixel == 2147483647);
    CHECK(parsed({"--seed", "0"}).seed == 0u);
    CHECK(parsed({"--max-depth", "1"}).max_depth == 1);
    CHECK(parsed({"--max-depth", "2147483646"}).max_depth == 2147483646);
    CHECK(parsed({"--aperture-angle", "0"}).camera.aperture_angle == 0.0);
    CHECK(parsed({"--vfov", "179.9"}).camera.vertical_fov == 179.9);
}

TEST_CASE("Options: an argument that may be repeated is, among options", "[cli]") {
    Options command("test", "");
    std::vector<std::string> files;
    bool flag = false;
    command.add({.name = "FILE", .value = "", .help = "", .required = true, .repeatable = true},
                file_names("FILE", files));
    command.add_flag("--flag", flag, "");
    const char* const words[] = {"test", "a", "b", "--flag", "c"};
    CHECK(command.parse(5, words));
    CHECK(files == std::vector<std::string>{"a", "b", "c"});
    CHECK(flag);
}

TEST_CASE("Options: unknown, repeated and incomplete ones are refused by name", "[cli]") {
    CHECK(refusal({"--bogus"}).find("--bogus") != std::string::npos);
    CHECK(refusal({"stray"}).find("stray") != std::string::npos);
    CHECK(refusal({"--spp"}).find("--spp") != std::string::npos);
    CHECK(refusal({"--spp", "4", "--spp", "5"}).find("--spp") != std::string::npos);
    CHECK(refusal({"-o"}).find("-o") != std::string::npos);
    CHECK(refusal({"-o", "a.exr", "b.exr"}).find("b.exr") != std::string::npos);  // one file for each -o
    CHECK(refusal({"--bogus"}).find("(see test --help)") != std::string::npos);
}

TEST_CASE("Options: a message names what is wrong first: the unknown, the missing value, the second time", "[cli]") {
    CHECK(refusal({"--sp", "4"}) == "unknown option --sp; did you mean --spp? (see test --help)");
    CHECK(refusal({"--sp=4"}) == "unknown option --sp; did you mean --spp? (see test --help)");
    CHECK(refusal({"4", "--bogus"}) == "unknown option --bogus (see test --help)");
    CHECK(refusal({"-x"}) == "unknown option -x (see test --help)");
    CHECK(refusal({"stray"}) == "unexpected argument 'stray' (see test --help)");
    CHECK(refusal({"--spp"}) == "--spp needs a value (see test --help)");
    CHECK(refusal({"--half=no"}) == "--half takes no value (see test --help)");
    CHECK(refusal({"--spp", "4", "--spp", "5"}) == "--spp is given 2 times");
}

TEST_CASE("Options: names of files are taken as they are written, brackets and braces too", "[cli]") {
    const RenderOptions o = parsed({"-o", "[a].exr", "-o", "{}.exr", "-o", "[a,b].png", "--report", "{}"});
    CHECK(o.outputs == std::vector<std::string>{"[a].exr", "{}.exr", "[a,b].png"});
    CHECK(o.report == "{}");
}

TEST_CASE("Options: a word is taken for a known one only where one letter in three differs at most, and two", "[cli]") {
    const std::vector<std::string> words{"--seed", "--spp", "--sampler"};
    CHECK(did_you_mean("--sedd", words) == "; did you mean --seed?");
    CHECK(did_you_mean("--saampller", words) == "; did you mean --sampler?");
    CHECK(did_you_mean("--smplr", words) == "; did you mean --sampler?");
    CHECK(did_you_mean("--bogus", words).empty());
    CHECK(did_you_mean("--x", words).empty());
    CHECK(did_you_mean("", words).empty());
    CHECK(did_you_mean("--seed", {}).empty());
}

TEST_CASE("Options: a camera that no figure could have is refused", "[cli]") {
    const auto check = [](const std::vector<const char*>& words) { check_camera_alone(parsed(words).camera); };
    CHECK_THROWS_AS(check({"--look-from", "1,2,3", "--look-at", "1,2,3"}), ArgumentError);
    CHECK_THROWS_AS(check({"--look-from", "0,5,0", "--look-at", "0,0,0", "--vup", "0,-1,0"}), ArgumentError);
    CHECK_NOTHROW(check({"--look-from", "0,5,0", "--look-at", "0,0,0", "--vup", "0,0,1"}));
    CHECK_NOTHROW(check({"--look-from", "0,0,0"}));
    CHECK_NOTHROW(check({"--look-at", "0,0,0"}));
    CHECK_NOTHROW(check({"--look-from", "0,5,0", "--look-at", "0,0,0"}));  // the figure may have another up
}

TEST_CASE("Options: the command line is kept as a shell would read it back", "[cli]") {
    const char* const argv[] = {"limn", "render", "a b.obj", "it's", "-o", "x.exr", ""};
    CHECK(command_line(7, argv) == R"(limn render 'a b.obj' 'it'\''s' -o x.exr '')");
    const auto read_back = [](const std::vector<std::string>& words) {
        std::vector<const char*> pointers;
        std::string expected;
        for (const std::string& word : words) pointers.push_back(word.c_str()), expected += word + "|";
        const std::string line = command_line(static_cast<int>(words.size()), pointers.data());
        return test::run("/bin/sh", {"-c", "printf '%s|' " + line}).out == expected;
    };
    std::vector<std::string> names;  // every character before what might be a variable, a file or a command
    for (char c = 1; c < 127; ++c) names.insert(names.end(), {std::string(1, c), c + std::string("HOME")});
    CHECK(read_back(names));
    test::holds([&](std::vector<std::string> words) {
        if (words.empty()) RC_DISCARD("printf would write its format once");
        for (std::string& word : words) std::replace(word.begin(), word.end(), '\0', '$');  // no argument can hold it
        RC_ASSERT(read_back(words));
    });
}

}  // namespace
}  // namespace limn::app::options_test
