// Pictures with alpha, with further channels, and parts of larger ones.
#include "catch.h"
#include "io/image_codec.h"
#include "limn/core/error.h"
#include "limn/io/image_io.h"
#include "support/folder.h"

using namespace limn;
using namespace limn::test;

namespace {

using ChannelNames = std::vector<std::string>;

ChannelNames names_of(const std::string& path) {
    ChannelNames names;
    for (const ImageChannel& channel : load_image_info(path).channels) names.push_back(channel.name);
    return names;
}

// Colours times alpha, which is 0, 1/4, 1/2 and 1.
const std::vector<float> kAlpha = {0, 0.25F, 0.5F, 1};
Image premultiplied() {
    Image image(2, 2);
    image.set(1, 0, {0.25, 0.125, 0});
    image.set(0, 1, {0.25, 0.125, 0});
    image.set(1, 1, {0.25, 0.125, 0});
    return image;
}

}  // namespace

TEST_CASE("PNG: alpha is kept, and colours are divided by it", "[io][image][alpha]") {
    const Folder folder;
    const std::string path = folder.path("a.png");
    save_image(premultiplied(), path, {.alpha = kAlpha});
    CHECK(names_of(path) == ChannelNames{"R", "G", "B", "A"});
    const Image image = load_image(path);
    const auto near = [](const Color& a, const Color& b) {
        return max_component(a - b) <= 0.005 && max_component(b - a) <= 0.005;
    };
    CHECK(image.at(0, 0) == Color{});
    CHECK(near(image.at(1, 0), {1, 0.5, 0}));
    CHECK(near(image.at(0, 1), {0.5, 0.25, 0}));
    CHECK(near(image.at(1, 1), {0.25, 0.125, 0}));
    save_image(premultiplied(), path);
    CHECK(names_of(path) == ChannelNames{"R", "G", "B"});
}

TEST_CASE("PNG: exposure brightens what is written", "[io][image]") {
    const Folder folder;
    save_image(Image(1, 1, {0.25, 0.125, 0.0625}), folder.path("a.png"), {.exposure = 2});
    const Color c = load_image(folder.path("a.png")).at(0, 0);
    CHECK(c.r == Approx(1));
    CHECK(c.g == Approx(0.5).margin(0.005));
    CHECK(c.b == Approx(0.25).margin(0.005));
    CHECK_THROWS_AS(save_image(Image(1, 1), folder.path("b.png"), {.exposure = std::nan("")}), ArgumentError);
}

TEST_CASE("save_image: alpha that has not one value a pixel is refused", "[io][image][alpha]") {
    const Folder folder;
    CHECK_THROWS_WITH(save_image(Image(2, 2), folder.path("a.png"), {.alpha = {1, 1, 1}}), Catch::Contains("alpha"));
}

#ifdef LIMN_WITH_OPENIMAGEIO

TEST_CASE("EXR: alpha is a channel beside colours that are multiplied by it, and layers beside both",
          "[io][image][alpha]") {
    const Folder folder;
    const std::string path = folder.path("a.exr");
    const std::vector<float> one = {1, 2, 3, 4}, two = {5, 6, 7, 8}, three = {9, 10, 11, 12};
    for (const bool half : {false, true}) {
        // In an order that is neither the alphabet's nor that of readers.
        const SaveOptions options{.half = half,
                                  .layers = {{"normal.Z", one},
                                             {"albedo.B", two},
                                             {"depth", three},
                                             {"normal.X", two},
                                             {"albedo.R", three},
                                             {"samples", one},
                                             {"albedo.G", one}},
                                  .alpha = kAlpha};
        save_image(premultiplied(), path, options);
        CHECK(load_image(path) == premultiplied());
        ChannelNames names = names_of(path);
        CHECK(names.size() == 11);
        CHECK(ChannelNames(names.begin(), names.begin() + 4) == ChannelNames{"R", "G", "B", "A"});
        for (const ImageLayer& layer : options.layers) CHECK(std::ranges::count(names, layer.name) == 1);
        for (const ImageChannel& c : load_image_info(path).channels)
            CHECK(c.type == (half && c.name.size() == 1 ? "half" : "float"));
    }
}

TEST_CASE("EXR: of a part the data window is its own, and the display window that of the whole", "[io][image]") {
    const Folder folder;
    const std::string path = folder.path("a.exr");
    const PartOf part{3, 5, 20, 10};
    save_image(premultiplied(), path, {.part_of = part});
    const ImageInfo info = load_image_info(path);
    CHECK(info.part_of == part);
    CHECK(info.width == 2);
    CHECK(info.height == 2);
    CHECK(load_image(path) == premultiplied());
    save_image(premultiplied(), path);
    CHECK_FALSE(load_image_info(path).part_of);
    for (const PartOf& bad : {PartOf{19, 5, 20, 10}, PartOf{3, 9, 20, 10}, PartOf{-1, 0, 20, 10}, PartOf{}})
        CHECK_THROWS_WITH(save_image(premultiplied(), path, {.part_of = bad}), Catch::Contains("does not lie"));
}

#endif
