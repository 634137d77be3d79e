// What `limn render` writes.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "house.h"
#include "limn/io/image_io.h"
#include "limn/render/render.h"
#include "process.h"
#include "support/folder.h"

namespace limn::test::render_test {
namespace {

using Json = nlohmann::json;

std::set<std::string> keys(const Json& object) {
    std::set<std::string> names;
    for (const auto& item : object.items()) names.insert(item.key());
    return names;
}

TEST_CASE("limn render: writes every output and the report, and only those", "[cli]") {
    const Folder folder;
    const std::string model = folder.write("house.obj", house_obj());
    const Outcome outcome =
        limn({"render", model, "-o", folder.path("a.exr"), "-o", folder.path("a.png"), "--size", "20x14", "--spp", "8",
              "--seed", "5", "--threads", "2", "--report", folder.path("r.json")});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find('\r') == std::string::npos);  // no progress bar
    const std::string summary = "limn: " + folder.path("a.exr") + ", " + folder.path("a.png") + ": 20x14, 8 samples";
    CHECK(outcome.err.starts_with(summary));
    CHECK(outcome.err.find(" s, relMSE 0.") != std::string::npos);
    CHECK(folder.names() == Names{"a.exr", "a.png", "house.obj", "r.json"});

    const Image exr = load_image(folder.path("a.exr")), png = load_image(folder.path("a.png"));
    REQUIRE(exr.width() == 20);
    REQUIRE(exr.height() == 14);
    REQUIRE(png.width() == 20);
    REQUIRE(png.height() == 14);
    // The PNG is the EXR in steps of 1/255 of the sRGB transfer.
    for (std::size_t i = 0; i < exr.values().size(); ++i) {
        const double wanted = std::min(1.0, srgb_encode(static_cast<double>(exr.values()[i])));
        CHECK(std::abs(srgb_encode(static_cast<double>(png.values()[i])) - wanted) <= 0.5 / 255 + 1e-6);
    }

    const Json report = Json::parse(folder.read("r.json"));
    CHECK(keys(report) == std::set<std::string>{"scene", "width", "height", "seed", "threads", "spp", "seconds", "rays",
                                                "mrays_per_second", "error", "stopped_by", "nonfinite_samples",
                                                "unusable_rays", "features", "memory_bytes", "version"});
    CHECK(keys(report["seconds"]) == std::set<std::string>{"compile", "render", "save"});
    CHECK(keys(report["error"]) == std::set<std::string>{"metric", "estimate", "ci95_low", "ci95_high", "target",
                                                         "reached", "max_sample_share", "reason"});
    CHECK(report["scene"] == "house.obj");
    CHECK(report["width"] == 20);
    CHECK(report["height"] == 14);
    CHECK(report["seed"] == 5);
    CHECK(report["threads"] == 2);
    CHECK(report["spp"] == 8);
    CHECK(report["rays"] >= 20 * 14 * 8);
    CHECK(report["nonfinite_samples"] == 0);
    CHECK(report["unusable_rays"] == 0);
    CHECK(report["error"]["metric"] == "relMSE");
    CHECK(report["error"]["estimate"] > 0);
    CHECK(report["error"]["reason"].is_null());
    CHECK(report["features"].is_array());
    CHECK(std::count(report["features"].begin(), report["features"].end(), "mesh") == 1);
    CHECK(report["version"] == version());
}

TEST_CASE("limn render: a lamp too bright for half is clamped, with a warning, and costs no picture", "[cli]") {
    const Folder folder;
    folder.write("lamp.mtl", "newmtl lamp\nKe 1e6 1e6 1e6\n");
    const std::string model =
        folder.write("lamp.obj", "mtllib lamp.mtl\nusemtl lamp\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Outcome outcome = limn(
        {"render", model, "-o", folder.path("a.exr"), "--half", "--size", "16x16", "--spp", "4", "--no-antialias"});
    CHECK(outcome.status == 0);
    CHECK(outcome.err.find("65504") != std::string::npos);
    const auto brightest = [&] {
        const Image image = load_image(folder.path("a.exr"));
        return *std::max_element(image.values().begin(), image.values().end());
    };
    CHECK(brightest() == 65504.0F);
    // Values of 16 bits have 11 significant ones.
    const auto significant = [](float v) {
        int exponent = 0;
        const float m = std::ldexp(std::frexp(v, &exponent), 11);
        return m == std::nearbyint(m);
    };
    const Image image = load_image(folder.path("a.exr"));
    CHECK(std::all_of(image.values().begin(), image.values().end(), significant));

    const auto warns = [&](const std::string& radiance, const Words& more) {
        folder.write("lamp.mtl", "newmtl lamp\nKe " + radiance + " " + radiance + " " + radiance + "\n");
        Words words = {"render", model, "-o", folder.path("a.exr"), "--size", "16x16", "--spp", "4"};
        words.insert(words.end(), more.begin(), more.end());
        return limn(words).err.find("65504") != std::string::npos;
    };
    CHECK_FALSE(warns("65504", {"--half", "--no-antialias"}));
    CHECK(brightest() == 65504.0F);
    CHECK_FALSE(warns("1e6", {"--no-antialias"}));  // 32 bits hold it
    CHECK(brightest() == 1e6F);
}

TEST_CASE("limn render: the report goes to stdout alone for -", "[cli]") {
    const Folder folder;
    const std::string model = folder.write("house.obj", house_obj());
    const Outcome outcome =
        limn({"render", model, "-o", folder.path("a.exr"), "--size", "4x4", "--spp", "1", "--report", "-"});
    REQUIRE(outcome.status == 0);
    const Json report = Json::parse(outcome.out);
    CHECK(report["spp"] == 1);
    // One sample a pixel says nothing about its error.
    CHECK(report["error"]["estimate"].is_null());
    CHECK(report["error"]["ci95_high"].is_null());
    CHECK_FALSE(report["error"]["reason"].get<std::string>().empty());
}

TEST_CASE("limn render: --quiet says nothing, and the picture's header says how it was made", "[cli]") {
    const Folder folder;
    const std::string model = folder.write("house.obj", house_obj());
    const Outcome outcome = limn({"render", model, "-o", folder.path("a.exr"), "--size", "5x4", "--spp", "8", "--seed",
                                  "4294967296", "--max-depth", "unlimited", "--quiet"});
    REQUIRE(outcome.status == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
    std::map<std::string, std::string> facts;
    for (const auto& [name, value] : load_image_facts(folder.path("a.exr"))) facts[name] = value;
    CHECK(facts["scene"] == "house.obj");
    CHECK(facts["seed"] == "4294967296");
    CHECK(facts["spp"] == "8");
    CHECK(facts["max_depth"] == "unlimited");
    CHECK(facts["estimator"] == "path");
    CHECK(facts["version"] == version());
    CHECK(std::stod(facts["seconds.render"]) > 0);
    CHECK(std::stod(facts["error.estimate"]) >= 0);
    CHECK(facts["command_line"].find("--seed 4294967296") != std::string::npos);
}

TEST_CASE("limn render: the same seed gives the same bits on any number of threads, another seed others", "[cli]") {
    const Folder folder;
    const std::string model = folder.write("house.obj", house_obj());
    const auto picture = [&](const std::string& seed, const std::string& threads) {
        const std::string path = folder.path(seed + "-" + threads + ".exr");
        const Outcome outcome =
            limn({"render", model, "-o", path, "--size", "16x16", "--spp", "4", "--seed", seed, "--threads", threads});
        REQUIRE(outcome.status == 0);
        return load_image(path);
    };
    const Image one = picture("1", "1");
    CHECK(picture("1", "3") == one);
    CHECK_FALSE(picture("2", "1") == one);
}

TEST_CASE("limn render: the default view shows the whole model, lit and shaded", "[cli]") {
    const Folder folder;
    folder.write("red.mtl", "newmtl red\nKd 0.8 0.1 0.1\n");
    const std::string model = folder.write("house.obj", "mtllib red.mtl\nusemtl red\n" + house_obj());
    const auto render = [&](const std::string& name, const Words& camera) {
        Words words = {"render", model, "-o",      folder.path(name), "--size", "48x32",
                       "--spp",  "16",  "--quiet", "--ground",        "none"};
        words.insert(words.end(), camera.begin(), camera.end());
        REQUIRE(limn(words).status == 0);
        return load_image(folder.path(name));
    };
    const Image view = render("a.exr", {});
    // The sky is blue, the house red in whatever light.
    const auto is_sky = [](const Color& c) { return c.b > c.r; };
    int model_pixels = 0;
    double darkest = kInfinity, brightest = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 48; ++x) {
            const Color c = view.at(x, y);
            CHECK(max_component(c) <= 1);  // the lamp, many times brighter, is not in the picture
            const bool at_border = x == 0 || y == 0 || x == 47 || y == 31;
            if (at_border) CHECK(is_sky(c));
            if (is_sky(c)) continue;
            ++model_pixels;
            darkest = std::min(darkest, luminance(c));
            brightest = std::max(brightest, luminance(c));
        }
    CHECK(model_pixels > 48 * 32 / 10);
    CHECK(brightest > 2 * darkest);
    // The camera options turn the view: from behind and far away the model is small.
    const Image far = render("b.exr", {"--look-from", "0,2,-200", "--look-at", "0,2,0", "--vfov", "20"});
    CHECK(is_sky(far.at(0, 16)));
    CHECK(is_sky(far.at(30, 16)));
    CHECK_FALSE(far == view);
}

TEST_CASE("limn render: the default view shows the whole model in a tall picture too", "[cli]") {
    const Folder folder;
    folder.write("red.mtl", "newmtl red\nKd 0.8 0.1 0.1\n");
    const std::string model = folder.write("house.obj", "mtllib red.mtl\nusemtl red\n" + house_obj());
    const std::string picture = folder.path("a.exr");
    REQUIRE(
        limn({"render", model, "-o", picture, "--size", "16x48", "--spp", "4", "--quiet", "--ground", "none"}).status ==
        0);
    const Image view = load_image(picture);
    const auto is_sky = [&](int x, int y) { return view.at(x, y).b > view.at(x, y).r; };
    for (int y = 0; y < 48; ++y) CHECK((is_sky(0, y) && is_sky(15, y)));
    CHECK_FALSE(is_sky(8, 24));
}

TEST_CASE("limn render: to an error, with the error and the samples of each pixel beside its colour", "[cli]") {
    const Folder folder;
    const std::string model = folder.write("house.obj", house_obj());
    const Outcome outcome = limn({"render", model, "-o", folder.path("a.exr"), "-o", folder.path("a.png"), "--size",
                                  "20x14", "--error", "1e-3", "--channels", "samples,error", "--report", "-"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const Json report = Json::parse(outcome.out);
    CHECK(report["stopped_by"] == "error");
    CHECK(report["error"]["target"] == 1e-3);
    CHECK(report["error"]["reached"] == true);
    CHECK(report["error"]["ci95_high"] <= 1e-3);
    CHECK(report["spp"] >= 8);
    std::vector<std::string> names;
    for (const ImageChannel& c : load_image_info(folder.path("a.exr")).channels) names.push_back(c.name);
    CHECK(names == std::vector<std::string>{"R", "G", "B", "error", "samples"});
    CHECK(load_image_info(folder.path("a.png")).channels.size() == 3);
    // The same picture as without them.
    REQUIRE(limn({"render", model, "-o", folder.path("b.exr"), "--size", "20x14", "--error", "1e-3"}).status == 0);
    CHECK(load_image(folder.path("a.exr")) == load_image(folder.path("b.exr")));
}

TEST_CASE("limn render: what was not reached within --spp or --time-limit is said, and no failure", "[cli]") {
    const Folder folder;
    const std::string model = folder.write("house.obj", house_obj());
    const Outcome capped = limn({"render", model, "-o", folder.path("a.exr"), "--size", "20x14", "--error", "1e-9",
                                 "--spp", "70", "--report", "-"});
    CHECK(capped.status == 0);
    CHECK(capped.err.find("1e-09 was not reached") != std::string::npos);
    CHECK(Json::parse(capped.out)["stopped_by"] == "samples");
    CHECK(Json::parse(capped.out)["spp"] == 70);
    CHECK(Json::parse(capped.out)["error"]["reached"] == false);
    const Outcome timed =
        limn({"render", model, "-o", folder.path("b.exr"), "--size", "20x14", "--time-limit", "0.05", "--report", "-"});
    CHECK(timed.status == 0);
    CHECK(Json::parse(timed.out)["stopped_by"] == "time");
    CHECK(Json::parse(timed.out)["error"]["estimate"] > 0);
    CHECK(load_image_facts(folder.path("b.exr")).size() > 10);
}

}  // namespace
}  // namespace limn::test::render_test
