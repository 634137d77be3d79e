// Exit status, streams, and that nothing is written or harmed when limn refuses.
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>

#include "catch.h"
#include "house.h"
#include "limn/io/image_io.h"
#include "limn/render/film.h"
#include "process.h"
#include "support/folder.h"
#include "support/text.h"

namespace limn::test::refusals_test {
namespace {

TEST_CASE("limn: version and help go to stdout with status 0", "[cli]") {
    const Outcome version = limn({"--version"});
    CHECK(version.status == 0);
    CHECK(version.err.empty());
    int major = -1, minor = -1, patch = -1, end = 0;
    REQUIRE(std::sscanf(version.out.c_str(), "limn %d.%d.%d%n", &major, &minor, &patch, &end) == 3);
    CHECK(version.out.substr(static_cast<std::size_t>(end)) == "\n");

    for (const Words& words :
         {Words{"--help"}, Words{"render", "--help"}, Words{"compare", "--help"}, Words{"info", "--help"},
          Words{"trace", "--help"}, Words{"bench", "--help"}, Words{"help"}}) {
        const Outcome help = limn(words);
        CHECK(help.status == 0);
        CHECK(help.err.empty());
        CHECK(contains(help.out, words.front() == words.back() ? "limn render" : words.front()));
    }
    for (const std::string command : {"render", "compare", "info", "trace", "bench"}) {
        const Outcome help = limn({"help", command});
        CHECK(help.status == 0);
        CHECK(help.out == limn({command, "--help"}).out);
        CHECK(contains(limn({"help"}).out, "limn " + command));
    }
    for (const Words& words :
         {Words{"help"}, Words{"help", "help"}, Words{"help", "--help"}, Words{"help", "--version"}})
        CHECK(limn(words).out == limn({"--help"}).out);
}

// The lines of a help text, each option's on one, with one space where it was wrapped.
std::vector<std::string> unwrapped(const std::string& help) {
    std::vector<std::string> lines;
    std::istringstream in(help);
    for (std::string line; std::getline(in, line);) {
        const std::size_t begin = line.find_first_not_of(' ');
        if (!lines.empty() && begin != std::string::npos && begin > 2)
            lines.back() += " " + line.substr(begin);
        else
            lines.push_back(line);
    }
    return lines;
}

std::string line_of(const std::string& help, const std::string& option) {
    for (const std::string& line : unwrapped(help))
        if (line.starts_with("  " + option + " ")) return line;
    return "";
}

TEST_CASE("limn: --help states of each option that takes a value what holds without it, or that it is required",
          "[cli]") {
    std::vector<std::string> texts{run(TINY_FIGURE_PROGRAM, {"--help"}).out};
    for (const char* command : {"render", "merge", "compare", "info", "trace", "bench"})
        texts.push_back(limn({command, "--help"}).out);
    int options = 0;
    for (const std::string& text : texts) {
        for (const std::string& line : unwrapped(text)) {
            const bool takes_value = line.starts_with("  -") && line.find(' ', 2) != line.find("  ", 2);
            if (!takes_value) continue;
            ++options;
            CAPTURE(line);
            CHECK((contains(line, "(default: ") || contains(line, " REQUIRED")));
        }
    }
    CHECK(options >= 50);
}

TEST_CASE("limn: the defaults in --help are those of the library, and of a figure its own", "[cli]") {
    const std::string render = limn({"render", "--help"}).out, figure = run(TINY_FIGURE_PROGRAM, {"--help"}).out;
    CHECK(line_of(render, "--spp N").ends_with("(default: 8; 1048576 with --error or --time-limit)"));
    CHECK(RenderSettings{}.samples_per_pixel == 64);
    CHECK(SamplePlan::kFirstPass == 8);  // from so many on the error is known
    CHECK(line_of(render, "--size WxH").ends_with("(default: 400x400)"));
    CHECK(line_of(render, "--max-depth N|unlimited").ends_with("(default: 10)"));
    CHECK(line_of(render, "--vfov DEG").ends_with("(default: 30)"));
    CHECK(line_of(figure, "--spp N").ends_with("(default: 4; 1048576 with --error or --time-limit)"));
    CHECK(line_of(figure, "--size WxH").ends_with("(default: 6x4)"));
    CHECK(line_of(figure, "--max-depth N|unlimited").ends_with("(default: 3)"));
    CHECK(line_of(figure, "--look-from x,y,z").ends_with("(default: 0,0,30)"));
    CHECK(line_of(figure, "--vfov DEG").ends_with("(default: 10)"));
    CHECK(line_of(figure, "-o,--output FILE").ends_with("(default: tiny.exr and tiny.png)"));
}

TEST_CASE("limn: --help names the channels that a command can write, and no others", "[cli]") {
    const std::string render = line_of(limn({"render", "--help"}).out, "--channels LIST"),
                      merge = line_of(limn({"merge", "--help"}).out, "--channels LIST");
    for (const char* of_film : {"error", "samples"}) CHECK((contains(render, of_film) && contains(merge, of_film)));
    for (const char* of_scene : {"albedo", "normal", "position", "depth", "object", "primitive"})
        CHECK((contains(render, of_scene) && !contains(merge, of_scene)));
}

TEST_CASE("limn: wrong arguments end with status 2, a message on stderr and nothing on stdout", "[cli]") {
    const Folder folder;
    const std::string model = folder.write("house.obj", house_obj()), out = folder.path("out.exr");
    const std::vector<std::pair<Words, std::string>> cases = {
        {{}, "usage"},
        {{"paint"}, "paint"},
        {{"rendr"}, "'rendr' is not a command; did you mean render?"},
        {{"help", "paint"}, "'paint' is not a command"},
        {{"help", "render", "info"}, "help: takes the name of one command"},
        {{"--version", "--quiet"}, "--version: a command comes first"},
        {{"render", model, "-o", out, "--sp", "4"}, "unknown option --sp; did you mean --spp?"},
        {{"render", "--sp", "4"}, "unknown option --sp"},
        {{"trace", model, "--any=1"}, "--any takes no value"},
        {{"render"}, "MODEL"},
        {{"render", model}, "-o"},
        {{"render", model, "-o", out, "--spp", "0"}, "--spp 0"},
        {{"render", model, "-o", out, "--bogus"}, "--bogus"},
        {{"render", model, "-o", out, "--error", "0"}, "--error 0: must be over 0"},
        {{"render", model, "-o", out, "--time-limit", "nan"}, "--time-limit nan"},
        {{"render", model, "-o", out, "--sampler", "halton"}, "--sampler halton: must be sobol or independent"},
        {{"render", model, "-o", out, "--channels", "error,colour"}, "--channels error,colour"},
        {{"render", model, "-o", out, "--crop", "1,2,3"}, "--crop 1,2,3: is not of the form X0,Y0,X1,Y1"},
        {{"render", model, "-o", out, "--crop", "1,2,3,x"}, "--crop 1,2,3,x: must be whole numbers"},
        {{"render", model, "-o", out, "--crop", "5,2,5,9"}, "--crop 5,2,5,9: holds no pixel"},
        {{"render", model, "-o", out, "--size", "8x8", "--crop", "0,0,9,8"},
         "--crop 0,0,9,8: reaches beyond the picture of 8x8"},
        {{"render", model, "-o", out, "--environment", ""}, "--environment '': is not the name of a file"},
        {{"render", model, "-o", out, "--camera", ""}, "--camera '': is not the name of a camera"},
        {{"render", model, "-o", out, "--projection", "fisheye"}, "--projection fisheye: must be perspective"},
        {{"render", model, "-o", out, "--height", "2"}, "--height: needs --projection orthographic"},
        {{"render", model, "-o", out, "--projection", "panorama", "--vfov", "20"},
         "--vfov: needs --projection perspective"},
        {{"render", model, "-o", out, "--projection", "panorama", "--aperture-angle", "1"}, "a panorama has no lens"},
        {{"render", model, "-o", out, "--background", "1,2"}, "--background 1,2"},
        {{"render", model, "-o", out, "--background", "1,2,-1"}, "--background 1,2,-1: must not be negative"},
        {{"render", model, "-o", out, "--ground", "grass"}, "--ground grass: must be none"},
        {{"render", model, "-o", out, "--smooth", "181"}, "--smooth 181: must be in 0 .. 180"},
        {{"render", model, "-o", out, "--preview", "0"}, "--preview 0: must be over 0"},
        {{"render", model, "--film", folder.path("a.film"), "--preview", "1"}, "--preview: there is no -o"},
        {{"render", model, "-o", out, "--exposure", "bright"}, "--exposure bright"},
        {{"merge", model, "-o", out, "--channels", "error,albedo"},
         "--channels error,albedo: only error and samples are possible: the other channels need the scene, which a "
         "film does not store"},
        {{"trace", "-"}, "MODEL -: standard input cannot be the rays too"},
        {{"render", model, "-o", folder.path("out.png"), "--channels", "error"}, "--channels: only an EXR"},
        {{"render", model, "-o", out, "--resume"}, "--resume"},
        {{"render", model, "-o", out, "--report", ""}, "--report '': is not the name of a file"},
        {{"render", model, "-o", ""}, "-o '': is not the name of a file"},
        {{"render", model, "-o", out, "-o", ""}, "-o ''"},
        {{"render", "", "-o", out}, "MODEL '': is not the name of a file"},
        {{"compare", "", "two.exr"}, "TEST ''"},
        {{"compare", "one.exr", ""}, "REF ''"},
        {{"compare", "one.exr", "two.exr", ""}, "REF_B ''"},
        {{"compare", "one.exr", "two.exr", "--json", ""}, "--json ''"},
        {{"render", model, "-o", folder.path("out.xyz")}, "out.xyz: the name of a picture must end in .exr or .png"},
        {{"render", model, "-o", folder.path("out")}, "must end in"},
        {{"render", model, "-o", out, "-o", folder.path("no/out.jpg")}, "must end in"},
        {{"render", model, "-o", out, "-o", folder.path("./out.exr")}, "out.exr"},
        {{"render", model, "-o", out, "--report", out}, "out.exr"},
        {{"render", model, "-o", out, "--report", model}, "house.obj"},
        {{"render", model, "-o", out, "--look-from", "1,1,1", "--look-at", "1,1,1"}, "look-from"},
        {{"render", model, "-o", out, "--look-from", "0,9,0", "--look-at", "0,0,0"}, "up"},
        {{"merge", "a.film", "b.film"}, "-o is missing"},
        {{"merge", "-o", out}, "FILM"},
        {{"compare", "one.exr"}, "REF"},
        {{"info"}, "FILE"},
        {{"info", model, "--json", ""}, "--json"},
        {{"info", model, "--json", model}, "house.obj"},
        {{"trace"}, "MODEL"},
        {{"trace", model, "--rays"}, "--rays"},
        {{"trace", model, "--rays", ""}, "--rays"},
        {{"trace", model, "--spp", "4"}, "--spp"},
    };
    for (const auto& [words, named] : cases) {
        CAPTURE(words);
        const Outcome outcome = limn(words);
        CHECK(outcome.status == 2);
        CHECK(contains(outcome.err, named));
        CHECK(outcome.err.starts_with("limn: "));
        CHECK(outcome.out.empty());
    }
    CHECK(folder.names() == Names{"house.obj"});
    CHECK(folder.read("house.obj") == house_obj());
}

TEST_CASE("limn render: files that cannot be read or written end with status 1 before rendering", "[cli]") {
    const Folder folder;
    const std::string model = folder.write("house.obj", house_obj()), out = folder.path("out.exr");
    const std::string empty = folder.write("empty.obj", "# nothing\n");
    const std::string broken = folder.write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    const std::string circle = folder.path("circle.exr");
    std::filesystem::create_symlink("circle.exr", circle);
    const std::vector<std::pair<Words, std::string>> cases = {
        {{folder.path("none.obj"), "-o", out}, "none.obj"},
        {{folder.path(), "-o", out}, folder.path()},
        {{empty, "-o", out}, "empty.obj"},
        {{broken, "-o", out}, "broken.obj"},
        {{model, "-o", folder.path("no/out.exr")}, "no/out.exr"},
        {{model, "-o", folder.path("house.obj/out.exr")}, "out.exr"},
        {{folder.make_pipe("pipe.obj"), "-o", out}, "pipe.obj: is not a regular file"},
        {{"/dev/zero", "-o", out}, "/dev/zero: is not a regular file"},
        {{model, "-o", folder.make_pipe("pipe.exr")}, "pipe.exr: is not a regular file"},
        {{model, "-o", circle}, "circle.exr: is a link that leads in a circle"},
        {{model, "-o", out, "-o", folder.path("no/out.png")}, "no/out.png"},
        {{model, "-o", out, "--report", folder.path("no/report.json")}, "report.json"},
        {{model, "-o", out, "--report", folder.path()}, folder.path()},
        {{model, "-o", out, "--report", "/dev/null"}, "/dev/null"},
    };
    const Names before = folder.names();
    for (const auto& [arguments, named] : cases) {
        // So many samples that anything that is refused late does not end.
        Words words = {"render", "--quiet", "--spp", "1000000000"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        CAPTURE(words);
        const Outcome outcome = limn(words);
        CHECK(outcome.status == 1);
        CHECK(contains(outcome.err, named));
        CHECK(outcome.out.empty());
    }
    CHECK(folder.names() == before);
}

TEST_CASE("limn render: a refusal leaves the picture and the report that were there as they were", "[cli]") {
    const Folder folder;
    const std::string model = folder.write("house.obj", house_obj());
    const std::string picture = folder.write("old.exr", "an old picture");
    const std::string report = folder.write("old.json", "an old report");
    const Names before = folder.names();
    const Words files = {"-o", picture, "--report", report};
    for (Words words : {Words{"render", folder.path("none.obj")}, Words{"render", model, "--vfov", "0"},
                        Words{"render", model, "-o", folder.path("no/x.png")}}) {
        words.insert(words.end(), files.begin(), files.end());
        CAPTURE(words);
        CHECK(limn(words).status != 0);
        CHECK(folder.read("old.exr") == "an old picture");
        CHECK(folder.read("old.json") == "an old report");
    }
    CHECK(folder.names() == before);
}

TEST_CASE("limn render: no output replaces a file that the model is made of, by whatever name", "[cli]") {
    const Folder folder;
    save_image(Image(1, 1), folder.path("wood.png"));
    folder.write("oak.mtl", "newmtl oak\nmap_Kd wood.png\n");
    const std::string model = folder.write("house.obj", "mtllib oak.mtl\nusemtl oak\n" + house_obj());
    std::filesystem::create_symlink("oak.mtl", folder.path("link.json"));
    std::filesystem::create_symlink(".", folder.path("here"));
    const std::map<std::string, std::string> before = folder.contents();
    const std::vector<std::pair<Words, int>> cases = {
        {{"--report", model}, 2},  // the command line alone says so
        {{"--report", folder.path("here/house.obj")}, 2},
        {{"--report", folder.path("oak.mtl")}, 2},  // it takes the model to know
        {{"--report", folder.path("link.json")}, 2},
        {{"-o", folder.path("wood.png")}, 2},
        {{"-o", folder.path("here/./wood.png")}, 2},
    };
    for (const auto& [output, status] : cases) {
        Words words = {"render", model, "-o", folder.path("out.exr"), "--spp", "1000000000", "--quiet"};
        words.insert(words.end(), output.begin(), output.end());
        CAPTURE(words);
        const Outcome outcome = limn(words);
        CHECK(outcome.status == status);
        CHECK(contains(outcome.err, output.back() + ": would replace a file that is read"));
        CHECK(folder.contents() == before);
    }
}

}  // namespace
}  // namespace limn::test::refusals_test
