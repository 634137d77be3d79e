// What save_image writes, load_image reads.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "catch.h"
#include "formats.h"
#include "io/picture_checks.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "support/folder.h"

namespace limn::image_round_trip_test {

using namespace test;

TEST_CASE("PNG: 8-bit values survive saving and loading, all 256", "[io][image]") {
    const Folder folder;
    Image image(256, 1);
    for (int i = 0; i < 256; ++i) {
        const double v = srgb_decode(i / 255.0);
        image.set(i, 0, Color{v, v, v});
    }
    save_image(image, folder.path("a.png"));
    CHECK(load_image(folder.path("a.png")) == image);
    const Image raw = load_image(folder.path("a.png"), Encoding::raw);
    for (int i = 0; i < 256; ++i) CHECK(raw.at(i, 0).g == static_cast<float>(i / 255.0));
}

TEST_CASE("PNG: values are rounded to the nearest stored one, and clamped", "[io][image]") {
    const Folder folder;
    const auto stored = [&folder](double linear) {
        save_image(Image(1, 1, Color{linear, linear, linear}), folder.path("a.png"));
        return std::lround(255 * load_image(folder.path("a.png"), Encoding::raw).at(0, 0).r);
    };
    CHECK(stored(srgb_decode(100.49 / 255)) == 100);
    CHECK(stored(srgb_decode(100.51 / 255)) == 101);
    CHECK(stored(-3) == 0);
    CHECK(stored(-0.0) == 0);
    CHECK(stored(1e30) == 255);
}

TEST_CASE("PNG: the file says that its transfer is sRGB", "[io][image]") {
    const Folder folder;
    save_image(noise(3, 3, 1), folder.path("a.png"));
    const std::string file = folder.read("a.png");
    const auto chunks = png_header_chunks(std::as_bytes(std::span(file)));
    CHECK(std::count_if(chunks.begin(), chunks.end(), [](const PngChunk& c) { return c.type == "sRGB"; }) == 1);
}

TEST_CASE("Images: rows run from the top and pixels from the left in every format", "[io][image]") {
    const Folder folder;
    Image image(5, 3);
    image.set(4, 0, Color{1, 0, 0});
    image.set(0, 2, Color{0, 1, 0});
    for (const std::string& suffix : written_suffixes()) {
        save_image(image, folder.path("a" + suffix));
        CHECK(load_image(folder.path("a" + suffix)) == image);
    }
}

TEST_CASE("Images: the suffix may be in capitals", "[io][image]") {
    const Folder folder;
    save_image(Image(2, 2), folder.path("a.PNG"));
    CHECK(load_image(folder.path("a.PNG")) == Image(2, 2));
}

TEST_CASE("Images: facts survive, whatever text they hold", "[io][image]") {
    const Folder folder;
    const std::map<std::string, std::string> facts{
        {"scene", "fig01_bouncing_spheres"},
        {"seed", "18446744073709551615"},
        {"command_line", "limn render \"my model.obj\" -o 'b\xc3\xa4r.exr' a=b"},
        {"time", "0.1"},
        {"long", std::string(3000, 'x')}};
    for (const std::string& suffix : written_suffixes()) {
        save_image(noise(4, 4, 1), folder.path("a" + suffix), {.facts = {facts.begin(), facts.end()}});
        const auto loaded = load_image_facts(folder.path("a" + suffix));
        CHECK(std::map<std::string, std::string>(loaded.begin(), loaded.end()) == facts);
        CHECK(load_image(folder.path("a" + suffix)).width() == 4);
    }
    save_image(noise(4, 4, 1), folder.path("plain.png"));
    CHECK(load_image_facts(folder.path("plain.png")).empty());
}

TEST_CASE("Images: the same picture and facts give the same bytes", "[io][image]") {
    const Folder folder;
    for (const std::string& suffix : written_suffixes()) {
        save_image(noise(40, 30, 2), folder.path("a" + suffix), {.facts = {{"seed", "1"}}});
        save_image(noise(40, 30, 2), folder.path("b" + suffix), {.facts = {{"seed", "1"}}});
        CHECK(folder.read("a" + suffix) == folder.read("b" + suffix));
    }
}

#ifdef LIMN_WITH_OPENIMAGEIO

TEST_CASE("EXR: float values survive bit for bit, every kind of them", "[io][image]") {
    const Folder folder;
    using Limits = std::numeric_limits<float>;
    std::vector<float> values{0.0f,
                              -0.0f,
                              Limits::denorm_min(),
                              -Limits::denorm_min(),
                              Limits::min(),
                              Limits::max(),
                              Limits::lowest(),
                              Limits::infinity(),
                              -Limits::infinity(),
                              1.0f / 3,
                              65520.0f,
                              Limits::quiet_NaN()};
    std::mt19937 generator(7);
    while (values.size() < 3 * 200 * 100) {
        const float v = std::bit_cast<float>(static_cast<std::uint32_t>(generator()));
        if (!std::isnan(v)) values.push_back(v);
    }
    Image image(200, 100);
    std::copy(values.begin(), values.end(), image.values().begin());
    save_image(image, folder.path("a.exr"));
    const Image loaded = load_image(folder.path("a.exr"));
    REQUIRE(loaded.width() == 200);
    CHECK(std::equal(values.begin(), values.end(), loaded.values().begin(), loaded.values().end(),
                     [](float a, float b) { return bits(a) == bits(b); }));
}

TEST_CASE("EXR: half is the nearest one, ties to even, infinities and NaN stay", "[io][image]") {
    const Folder folder;
    const std::vector<std::pair<float, float>> cases{
        {1, 1},         {65504, 65504},       {-65504, -65504},       {2049, 2048},          {2051, 2052},
        {-0.0f, -0.0f}, {0x1p-24f, 0x1p-24f}, {0x1.8p-24f, 0x1p-23f}, {0x1p-25f, 0},         {0x1.8p-25f, 0x1p-24f},
        {1e-30f, 0},    {0.1f, 0x1.998p-4f},  {INFINITY, INFINITY},   {-INFINITY, -INFINITY}};
    Image image(static_cast<int>(cases.size()), 1);
    for (std::size_t i = 0; i < cases.size(); ++i) image.values()[3 * i] = cases[i].first;
    image.values()[1] = NAN;
    save_image(image, folder.path("a.exr"), {.half = true});
    const Image loaded = load_image(folder.path("a.exr"));
    for (std::size_t i = 0; i < cases.size(); ++i) {
        CAPTURE(cases[i].first);
        CHECK(bits(loaded.values()[3 * i]) == bits(cases[i].second));
    }
    CHECK(std::isnan(loaded.values()[1]));
    save_image(noise(64, 64, 1), folder.path("half.exr"), {.half = true});
    save_image(noise(64, 64, 1), folder.path("float.exr"));
    CHECK(10 * folder.read("half.exr").size() < 7 * folder.read("float.exr").size());
}

TEST_CASE("EXR: the file names the primaries of BT.709", "[io][image]") {
    const Folder folder;
    save_image(Image(2, 2), folder.path("a.exr"));
    const std::string file = folder.read("a.exr");
    const std::size_t place = file.find(std::string("chromaticities\0chromaticities\0\x20\0\0\0", 34));
    REQUIRE(place != std::string::npos);
    const float expected[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
    CHECK(file.compare(place + 34, 32, std::string(reinterpret_cast<const char*>(expected), 32)) == 0);
}

TEST_CASE("EXR: facts may hold line breaks", "[io][image]") {
    const Folder folder;
    const auto suffix = GENERATE(".exr", ".png");
    save_image(Image(2, 2), folder.path("a") + suffix, {.facts = {{"notes", "one\ntwo\n"}}});
    const auto facts = load_image_facts(folder.path("a") + suffix);
    REQUIRE(facts.size() == 1);
    CHECK(facts[0].second == "one\ntwo\n");
}

#else

TEST_CASE("HDR: values are the nearest that share the largest one's exponent", "[io][image]") {
    const Folder folder;
    Image image(4, 1);
    image.set(0, 0, Color{1, 0.5, 0.001});   // last place 2^-7
    image.set(1, 0, Color{0.9999, 0.5, 0});  // rounds up to 1
    image.set(2, 0, Color{-2, 1e-33, 0});
    image.set(3, 0, Color{3e5, 2e5, 1e3});  // last place 2^11
    save_image(image, folder.path("a.hdr"));
    const Image loaded = load_image(folder.path("a.hdr"));
    CHECK(loaded.at(0, 0) == Color{1, 0.5, 0});
    CHECK(loaded.at(1, 0) == Color{1, 0.5, 0});
    CHECK(loaded.at(2, 0) == Color{0, 0, 0});
    CHECK(loaded.at(3, 0) == Color{2048 * 146, 2048 * 98, 0});
}

#endif

#ifdef LIMN_WITH_OPENIMAGEIO
TEST_CASE("EXR: layers stand beside the colours as floats, and change nothing of them", "[io][image]") {
    const Folder folder;
    Image image(2, 1);
    image.set(0, 0, {0.1, 0.2, 0.3});
    image.set(1, 0, {4, 5, 6});
    for (const bool half : {false, true}) {
        save_image(image, folder.path("plain.exr"), {.half = half});
        save_image(image, folder.path("a.exr"),
                   {.half = half, .layers = {{"samples", {70000, 3}}, {"error", {1e-9f, 0.5f}}}});
        CHECK(load_image(folder.path("a.exr")) == load_image(folder.path("plain.exr")));
        std::vector<std::pair<std::string, std::string>> channels;
        for (const ImageChannel& c : load_image_info(folder.path("a.exr")).channels)
            channels.emplace_back(c.name, c.type);
        const std::string colour = half ? "half" : "float";
        CHECK(channels == std::vector<std::pair<std::string, std::string>>{
                              {"R", colour}, {"G", colour}, {"B", colour}, {"error", "float"}, {"samples", "float"}});
    }
    CHECK((image_holds_layers("a.exr") && !image_holds_layers("a.png")));
    save_image(image, folder.path("a.png"), {.layers = {{"error", {1, 2}}}});
    CHECK(load_image_info(folder.path("a.png")).channels.size() == 3);
}

TEST_CASE("EXR: a layer of another size, without a name or with a colour's is refused", "[io][image]") {
    const Folder folder;
    const Image image(2, 1);
    const auto refused = [&](const std::vector<ImageLayer>& layers) {
        CHECK_THROWS_AS(save_image(image, folder.path("a.exr"), {.layers = layers}), ArgumentError);
    };
    refused({{"error", {1}}});
    refused({{"error", {1, 2, 3}}});
    refused({{"", {1, 2}}});
    refused({{"R", {1, 2}}});
    refused({{"a b", {1, 2}}});
    refused({{"z", {1, 2}}, {"z", {1, 2}}});
    CHECK(folder.names().empty());
}
#endif

}  // namespace limn::image_round_trip_test
