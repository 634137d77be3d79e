// Pictures with alpha, with further channels, and parts of larger ones.
#include "catch.h"
#include "io/image_codec.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "make_png.h"
#include "support/folder.h"

namespace limn::image_alpha_test {

using namespace test;

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

TEST_CASE("load_alpha: the alpha of a PNG, of grey and coloured ones, from file and memory", "[io][image][alpha]") {
    const Folder folder;
    const std::string path = folder.path("a.png");
    const auto check = [&](double tolerance) {
        const std::string bytes = folder.read("a.png");
        for (const auto& alpha : {load_alpha(path), load_alpha_from_memory(std::as_bytes(std::span(bytes)))}) {
            REQUIRE(alpha);
            REQUIRE(alpha->width() == 2);
            REQUIRE(alpha->height() == 2);
            for (std::size_t i = 0; i < 12; ++i) CHECK(alpha->values()[i] == Approx(kAlpha[i / 3]).margin(tolerance));
        }
    };
    save_image(premultiplied(), path, {.alpha = kAlpha});
    check(0.002);  // in 8 bits, without any transfer function
    save_image(premultiplied(), path);
    CHECK_FALSE(load_alpha(path));
    // Grey and alpha of 16 bits.
    std::string row;
    for (int y = 0; y < 2; ++y) {
        row += '\0';  // no filter
        for (int x = 0; x < 2; ++x) {
            const auto alpha = static_cast<unsigned>(std::lround(65535 * kAlpha[static_cast<std::size_t>(2 * y + x)]));
            row += std::string("\x12\x34", 2) + static_cast<char>(alpha >> 8) + static_cast<char>(alpha & 255);
        }
    }
    folder.write("a.png",
                 make_png({.width = 2, .height = 2, .bit_depth = 16, .color = PngColor::grey_alpha, .data = row}));
    check(1e-5);
    CHECK(load_image(path).at(0, 0).r == Approx(srgb_decode(0x1234 / 65535.0)));
}

TEST_CASE("load_alpha: the colour that a PNG without alpha calls transparent, from file and memory",
          "[io][image][alpha]") {
    const Folder folder;
    const auto check = [&](const std::string& png) {
        const std::string path = folder.write("a.png", png);
        for (const auto& alpha : {load_alpha(path), load_alpha_from_memory(std::as_bytes(std::span(png)))}) {
            REQUIRE(alpha);
            CHECK(alpha->at(0, 0) == Color{});
            CHECK(alpha->at(1, 0) == Color{1, 1, 1});
        }
        CHECK(load_image_from_memory(std::as_bytes(std::span(png)), Encoding::raw, "a").at(1, 0).r == Approx(1));
    };
    const std::string grey("\0\x07", 2), red("\0\xff\0\0\0\0", 6);
    check(make_png(2, 8, PngColor::grey, "\x07\xff", png_chunk("tRNS", grey)));
    check(make_png(2, 8, PngColor::rgb, std::string("\xff\0\0\xff\x01\0", 6), png_chunk("tRNS", red)));
    check(make_png(2, 16, PngColor::grey, std::string("\0\x07\xff\xff", 4), png_chunk("tRNS", grey)));
}

TEST_CASE("load_alpha: a TGA has alpha where it has four channels, a broken file is refused", "[io][image][alpha]") {
    const Folder folder;
    const auto tga = [](int channels, int alpha_bits) {
        std::string bytes(18, '\0');
        bytes[2] = 2, bytes[12] = 1, bytes[14] = 2;  // uncompressed colours, 1 x 2, the lowest row first
        bytes[16] = static_cast<char>(8 * channels), bytes[17] = static_cast<char>(alpha_bits);
        for (const char alpha : {'\x33', '\xff'}) {
            bytes += "\x01\x02\x03";
            if (channels == 4) bytes += alpha;
        }
        return bytes;
    };
    const auto alpha = load_alpha(folder.write("a.tga", tga(4, 8)));
    REQUIRE(alpha);
    CHECK(alpha->at(0, 0) == Color{1, 1, 1});
    CHECK(alpha->at(0, 1).g == Approx(0.2).epsilon(1e-6));
    CHECK_FALSE(load_alpha(folder.write("a.tga", tga(3, 0))));
    CHECK_THROWS_AS(load_alpha(folder.write("a.tga", tga(4, 8).substr(0, 20))), FileError);
    CHECK_THROWS_AS(load_alpha(folder.path("none.png")), FileError);
    CHECK_THROWS_WITH(load_alpha_from_memory({}, "that"), Catch::StartsWith("that: "));
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

TEST_CASE("load_alpha: of an EXR, also behind other channels, as stored", "[io][image][alpha]") {
    const Folder folder;
    const std::string path = folder.path("a.exr");
    save_image(premultiplied(), path, {.layers = {{"B.depth", {1, 2, 3, 4}}}, .alpha = {-1, 0.25F, 2, 1}});
    const std::string bytes = folder.read("a.exr");
    for (const auto& alpha : {load_alpha(path), load_alpha_from_memory(std::as_bytes(std::span(bytes)))}) {
        REQUIRE(alpha);
        CHECK(alpha->at(0, 0) == Color{-1, -1, -1});
        CHECK(alpha->at(0, 1) == Color{2, 2, 2});
    }
    save_image(premultiplied(), path);
    CHECK_FALSE(load_alpha(path));
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
        CHECK_THROWS_WITH(save_image(premultiplied(), path, {.part_of = bad}),
                          Catch::Contains("is not inside the whole"));
}

#endif

}  // namespace limn::image_alpha_test
